// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/messages.h"

// Here alone: it takes longer to compile than all that uses it.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cmath>

namespace roomcut::messages {

void start(Level level) {
  auto logger =
      std::make_shared<spdlog::logger>("roomcut", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("%^%v%$");
  logger->set_level(level == Level::kErrorsOnly ? spdlog::level::err
                    : level == Level::kDetails  ? spdlog::level::debug
                                                : spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void detail(const std::string& text) {
  spdlog::debug("{}", text);
}

void info(const std::string& text) {
  spdlog::info("{}", text);
}

void warn(const std::string& text) {
  spdlog::warn("{}", text);
}

std::string resources(double seconds, double megabytes) {
  return fmt::format("{:.2f} s, {:.0f} MB", seconds, megabytes);
}

std::string readable(double value) {
  if (std::isfinite(value) && value == std::floor(value) && std::abs(value) < 1e15) {
    return fmt::format("{:.0f}", value);
  }
  return fmt::format("{:.4g}", value);
}

}  // namespace roomcut::messages

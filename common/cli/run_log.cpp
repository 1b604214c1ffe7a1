// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "common/artefact/json_values.h"
#include "common/cli/stage_state.h"

namespace roomcut {

namespace {

/// JSON has no NaN; a log must not fail for one.
Json finite_or_text(double value) {
  return std::isfinite(value) ? Json(value) : Json(std::to_string(value));
}

std::string utc_text(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), length};
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// What this process has read or written so far, files and terminal; 0 where the system does not tell.
std::uint64_t bytes_moved(const std::string& key) {
  std::ifstream counters("/proc/self/io");
  std::string line;
  while (std::getline(counters, line)) {
    if (line.starts_with(key)) {
      return std::strtoull(line.c_str() + key.size(), nullptr, 10);
    }
  }
  return 0;
}

/// A log is read by people and tools alike; whatever bytes a file name has, it must stay valid JSON.
std::string utf8_or_escaped(const std::string& text) {
  return parse_json(lossy_json(text)).get<std::string>();
}

}  // namespace

std::string run_log(const StageRun::State& state, const std::vector<Problem>& problems, int exit_code) {
  const Usage used = usage_since(state.clock);
  Json log = {{"stage", state.info->name},
              {"revision", state.info->revision},
              {"version", ROOMCUT_VERSION},
              {"started", utc_text(state.started)},
              {"host", host_name()},
              {"exit_code", exit_code},
              {"wall_s", used.wall_s},
              {"cpu_s", used.cpu_s},
              {"peak_memory_mb", used.peak_mb},
              {"bytes_read", bytes_moved("rchar: ")},
              {"bytes_written", bytes_moved("wchar: ")},
              {"threads", state.threads},
              {"params", try_parse_json(state.params_json)},
              {"chosen", Json::array()},
              {"counts", Json::array()},
              {"notes", Json::array()},
              {"warnings", Json::array()},
              {"problems", Json::array()},
              {"inputs", Json::object()},
              {"outputs", Json::object()}};
  for (const Choice& choice : state.choices) {
    log["chosen"].push_back(
        {{"parameter", choice.parameter}, {"value", finite_or_text(choice.value)}, {"why", choice.why}});
  }
  for (const Count& count : state.counts) {
    log["counts"].push_back(
        {{"what", count.what}, {"value", finite_or_text(count.value)}, {"unit", count.unit}});
  }
  for (const std::string& note : state.notes) {
    log["notes"].push_back(utf8_or_escaped(note));
  }
  for (const std::string& warning : state.warnings) {
    log["warnings"].push_back(utf8_or_escaped(warning));
  }
  for (const Problem& problem : problems) {
    log["problems"].push_back({{"code", problem.code.id},
                               {"where", utf8_or_escaped(problem.where)},
                               {"what", utf8_or_escaped(problem.what)},
                               {"hint", utf8_or_escaped(problem.hint)}});
  }
  const auto list = [&state](const std::vector<StageFile>& files, Json& out) {
    for (const StageFile& file : files) {
      const auto found = state.files.find(file.name);
      if (found != state.files.end()) {
        out[file.name] = utf8_or_escaped(found->second.string());
      }
    }
  };
  list(state.info->inputs, log["inputs"]);
  list(state.info->outputs, log["outputs"]);
  return pretty_json(log);
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

/// Lines for the user, on standard error, in colour on a terminal; thread-safe. Not for stages: StageRun.
namespace roomcut::messages {

enum class Level { kErrorsOnly, kUsual, kDetails };

/// Before the first of them.
void start(Level level);

void detail(const std::string& text);  ///< only with kDetails
void info(const std::string& text);
void warn(const std::string& text);

/// "0.53 s, 210 MB".
std::string resources(double seconds, double megabytes);
/// A number as people read it: whole numbers in full, others with four digits.
std::string readable(double value);

}  // namespace roomcut::messages

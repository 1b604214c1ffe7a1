// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/cli/run_stage.h"

/// What StageRun and run_stage() share; not for stages.
namespace roomcut {

struct Choice {
  std::string parameter;
  double value;
  std::string why;
};

struct Count {
  std::string what;
  double value;
  std::string unit;
};

struct StageRun::State {
  const StageInfo* info = nullptr;
  const ParameterTable* table = nullptr;
  std::map<std::string, std::filesystem::path> files;  ///< inputs and outputs; names do not collide
  std::map<std::string, std::string> options;
  std::string params_json;
  int threads = 1;
  bool quiet = false;
  bool verbose = false;

  std::map<std::string, std::string> given_digests;  ///< by set_input_digest()
  std::vector<std::filesystem::path> also_written;   ///< by wrote()
  std::optional<Provenance> provenance;

  std::mutex mutex;  ///< guards what follows
  std::vector<Choice> choices;
  std::vector<Count> counts;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;

  std::chrono::system_clock::time_point started = std::chrono::system_clock::now();
  std::chrono::steady_clock::time_point clock = std::chrono::steady_clock::now();
};

/// N07 when memory runs out, wherever that is.
inline constexpr std::string_view kNoMemory = "there is not enough memory for this data";
inline constexpr std::string_view kNoMemoryHint = "close other programs, or use a machine with more memory";

/// Says N07 without any allocation, after temporary files are gone, and ends the process with its exit code.
[[noreturn]] void end_out_of_memory();

/// Resources of this process so far.
struct Usage {
  double wall_s;
  double cpu_s;
  double peak_mb;
};
Usage usage_since(std::chrono::steady_clock::time_point start);

/// The log of one run: what may differ between equal runs (times, host) and what the user may want to look
/// up; JSON.
std::string run_log(const StageRun::State& state, const std::vector<Problem>& problems, int exit_code);

/// SIGINT, SIGTERM, SIGHUP: temporary files go, then the process ends by the signal. SIGABRT (a failed
/// assertion) and crashes: the same, with exit code 1. SIGXFSZ is ignored, so that a write over the limit is
/// an error like a full disk.
void install_signal_handlers();

/// Processors that this process may use.
int available_threads();

}  // namespace roomcut

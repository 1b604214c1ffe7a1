// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/run_progress.h"

#include <sstream>

namespace roomcut::view {

void RunProgress::start() {
  *this = RunProgress();
  running = true;
}

void RunProgress::add_line(const std::string& line) {
  std::istringstream words(line);
  std::string mark, name;
  int number = 0, count = 0;
  if (line.starts_with("@stage ") && words >> mark >> number >> count >> name) {
    stage = name;
    done = number - 1;
    of = count;
    return;
  }
  if (line.starts_with("error[") && error.empty()) {
    error = line;
  } else if (line.starts_with("hint: ") && !error.empty() && error.find('\n') == std::string::npos) {
    error += "\n" + line;
  }
  log.push_back(line);
  if (log.size() > kLogLines) {
    log.pop_front();
  }
}

void RunProgress::finish(int code) {
  running = false;
  exit_code = code;
  if (code == 0) {
    done = of;
    stage.clear();
    error.clear();
  } else if (error.empty()) {
    error = log.empty() ? "the run ended with code " + std::to_string(code) : log.back();
  }
}

}  // namespace roomcut::view

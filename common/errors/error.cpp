// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/errors/error.h"

#include <utility>

namespace roomcut {

namespace {

std::string join(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    text += to_string(problem);
  }
  return text;
}

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text = std::string("error[") + problem.code.id + "] ";
  if (!problem.where.empty()) {
    text += problem.where + ": ";
  }
  text += problem.what + "\n";
  if (!problem.hint.empty()) {
    text += "hint: " + problem.hint + "\n";
  }
  return text;
}

StageError::StageError(std::vector<Problem> problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {
  if (problems_.empty()) {
    throw std::logic_error("StageError without a problem");
  }
}

StageError::StageError(ErrorCode code, std::string where, std::string what, std::string hint)
    : StageError(std::vector<Problem>{{code, std::move(where), std::move(what), std::move(hint)}}) {}

}  // namespace roomcut

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

/// A hostile file may have words of a megabyte; a message is for people.
std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 2000;
  return text.size() <= kMost ? text
                              : text.substr(0, kMost / 2) + " … " + text.substr(text.size() - kMost / 2);
}

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text = std::string("error[") + problem.code.id + "] ";
  if (!problem.where.empty()) {
    text += shortened(problem.where) + ": ";
  }
  text += shortened(problem.what) + "\n";
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

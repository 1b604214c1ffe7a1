// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"

namespace roomcut::accept_lines {

/// accept_lines has no parameters: what enters is decided by the files alone.
inline ParameterTable accept_lines_parameters() {
  return {};
}

}  // namespace roomcut::accept_lines

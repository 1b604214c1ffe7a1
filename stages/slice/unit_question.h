// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/slices/slices.h"

namespace roomcut::slice {

/// Whether a scan taken as metres may be in feet: all its storeys, at least two, or one of a small building,
/// are 7 to 11.5 m high, which in feet is 2.1 to 3.5 m. Returns the question for the user with the heights;
/// "" when there is none.
std::string unit_question(const Slices& slices);

}  // namespace roomcut::slice

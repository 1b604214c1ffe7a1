// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/slices/slices.h"

namespace roomcut::slice {

/// What to say of ceilings that are no planes, but facets of a vault or dome: their area, number and error;
/// "" below 10 m^2. Where they come down to the floor as walls do, no line follows them, and the model lacks
/// what lies there.
std::string vault_warning(const Slices& slices);

}  // namespace roomcut::slice

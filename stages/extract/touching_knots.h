// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/facet_surface.h"

namespace roomcut::extract {

/// The vertices at which facets do not bound a 2-manifold, ascending: ends of edges that are not run through
/// once each way, and places where several surfaces touch.
std::vector<std::int32_t> touching_knots(const FacetSurface& surface);

}  // namespace roomcut::extract

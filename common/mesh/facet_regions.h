// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/mesh/facet_surface.h"

// The combinatorial half of merge_facets(): regions, and which vertices survive.

namespace roomcut {

/// A directed edge on the border of a region; the region lies on its left.
struct BorderEdge {
  std::int32_t region, from, to;
  std::int64_t carrier;
};

struct FacetRegions {
  std::vector<std::int32_t> region_of;  ///< per facet
  std::int32_t count = 0;
  std::vector<BorderEdge> border;  ///< sorted by region, then from
};

/// Joins facets of equal plane, kind and storey across edges that exactly two facets share.
FacetRegions join_facets(const FacetSurface& surface);

/// 1 for every vertex that must stay a corner (see merge_facets()).
std::vector<std::uint8_t> find_corners(const FacetSurface& surface, const FacetRegions& regions,
                                       double straight_m);

/// The straightened border: for each region the segments from corner to corner, sorted by region.
struct BorderSegment {
  std::int32_t region;
  std::array<std::int32_t, 2> ends;
};
std::vector<BorderSegment> straighten(const FacetRegions& regions, const std::vector<std::uint8_t>& corner);

}  // namespace roomcut

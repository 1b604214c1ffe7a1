// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/touching_knots.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace roomcut::extract {

namespace {

/// A side of a facet, by its lower and its higher vertex.
struct Side {
  std::int32_t lo, hi;
  std::int32_t lo_corner, hi_corner;  ///< the facet's corners there
  bool forward;
};

std::vector<Side> sorted_sides(const FacetSurface& surface) {
  std::vector<Side> sides;
  sides.reserve(surface.corners.size());
  for (std::size_t f = 0; f < surface.facets(); ++f) {
    const std::int32_t first = surface.offset[f];
    const std::int32_t last = surface.offset[f + 1];
    for (std::int32_t c = first; c < last; ++c) {
      const std::int32_t next = c + 1 < last ? c + 1 : first;
      const std::int32_t a = surface.corners[static_cast<std::size_t>(c)];
      const std::int32_t b = surface.corners[static_cast<std::size_t>(next)];
      sides.push_back(a < b ? Side{a, b, c, next, true} : Side{b, a, next, c, false});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.lo, a.hi, a.lo_corner) < std::tie(b.lo, b.hi, b.lo_corner);
  });
  return sides;
}

std::int32_t root(std::vector<std::int32_t>& parent, std::int32_t i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    auto& up = parent[static_cast<std::size_t>(i)];
    up = parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

}  // namespace

std::vector<std::int32_t> touching_knots(const FacetSurface& surface) {
  const std::vector<Side> sides = sorted_sides(surface);
  std::vector<std::uint8_t> touching(surface.vertices.size(), 0);
  std::vector<std::int32_t> fan(surface.corners.size());  // corners joined across common sides
  std::iota(fan.begin(), fan.end(), 0);
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    for (; last < sides.size() && sides[last].lo == sides[first].lo && sides[last].hi == sides[first].hi;
         ++last) {
      fan[static_cast<std::size_t>(root(fan, sides[last].lo_corner))] = root(fan, sides[first].lo_corner);
      fan[static_cast<std::size_t>(root(fan, sides[last].hi_corner))] = root(fan, sides[first].hi_corner);
    }
    if (last - first != 2 || sides[first].forward == sides[first + 1].forward) {
      touching[static_cast<std::size_t>(sides[first].lo)] = 1;
      touching[static_cast<std::size_t>(sides[first].hi)] = 1;
    }
    first = last;
  }
  std::vector<std::int32_t> fan_of(surface.vertices.size(), -1);
  for (std::size_t c = 0; c < surface.corners.size(); ++c) {
    const auto vertex = static_cast<std::size_t>(surface.corners[c]);
    const std::int32_t own = root(fan, static_cast<std::int32_t>(c));
    if (fan_of[vertex] >= 0 && fan_of[vertex] != own) {
      touching[vertex] = 1;
    }
    fan_of[vertex] = own;
  }
  std::vector<std::int32_t> found;
  for (std::size_t v = 0; v < touching.size(); ++v) {
    if (touching[v] != 0) {
      found.push_back(static_cast<std::int32_t>(v));
    }
  }
  return found;
}

}  // namespace roomcut::extract

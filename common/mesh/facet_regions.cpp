// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/facet_regions.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace roomcut {

namespace {

struct HalfEdge {
  std::int32_t lo, hi;
  std::int32_t facet;
  std::int64_t carrier;
  bool forward;  // runs lo -> hi
};

std::vector<HalfEdge> sorted_half_edges(const FacetSurface& surface) {
  std::vector<HalfEdge> edges;
  edges.reserve(surface.corners.size());
  for (std::size_t f = 0; f < surface.facets(); ++f) {
    const auto first = static_cast<std::size_t>(surface.offset[f]);
    const std::size_t n = static_cast<std::size_t>(surface.offset[f + 1]) - first;
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t a = surface.corners[first + i];
      const std::int32_t b = surface.corners[first + (i + 1) % n];
      edges.push_back(
          {std::min(a, b), std::max(a, b), static_cast<std::int32_t>(f), surface.carrier[first + i], a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.lo, a.hi, a.facet, a.forward) < std::tie(b.lo, b.hi, b.facet, b.forward);
  });
  return edges;
}

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t root(std::int32_t i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      auto& up = parent_[static_cast<std::size_t>(i)];
      up = parent_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }
  void unite(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

// Calls visit(first, last) for each run of half-edges on one edge.
template <class Visit>
void for_each_edge(const std::vector<HalfEdge>& edges, const Visit& visit) {
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].lo == edges[first].lo && edges[last].hi == edges[first].hi) {
      ++last;
    }
    visit(first, last);
    first = last;
  }
}

// For each border edge the following one of its region's border; -1 where the border meets itself.
std::vector<std::int32_t> successors(const std::vector<BorderEdge>& border) {
  std::vector<std::int32_t> next(border.size(), -1);
  const auto before = [](const BorderEdge& a, const BorderEdge& b) {
    return std::tie(a.region, a.from) < std::tie(b.region, b.from);
  };
  for (std::size_t i = 0; i < border.size(); ++i) {
    const BorderEdge key{border[i].region, border[i].to, 0, 0};
    const auto [first, last] = std::equal_range(border.begin(), border.end(), key, before);
    if (last - first == 1) {
      next[i] = static_cast<std::int32_t>(first - border.begin());
    }
  }
  return next;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

// Follows the border from edge `start` to the next corner; the vertices passed over go to `dropped`.
// Returns the end, or -1 for a loop without a corner.
std::int32_t follow(const std::vector<BorderEdge>& border, const std::vector<std::int32_t>& next,
                    const std::vector<std::uint8_t>& corner, std::size_t start,
                    std::vector<std::int32_t>& dropped) {
  dropped.clear();
  std::size_t at = start;
  while (corner[static_cast<std::size_t>(border[at].to)] == 0) {
    dropped.push_back(border[at].to);
    at = static_cast<std::size_t>(next[at]);
    if (at == start) {
      return -1;
    }
  }
  return border[at].to;
}

// Promotes vertices that are not on the straight line between the corners around them; returns whether there
// were any.
bool promote_crooked(const FacetSurface& surface, const FacetRegions& regions,
                     const std::vector<std::int32_t>& next, double straight_m,
                     std::vector<std::uint8_t>& corner) {
  std::vector<std::int32_t> dropped;
  std::vector<std::int32_t> promoted;
  std::vector<std::uint8_t> seen(surface.vertices.size(), 0);
  const auto point = [&](std::int32_t v) { return surface.vertices[static_cast<std::size_t>(v)]; };
  for (std::size_t i = 0; i < regions.border.size(); ++i) {
    const std::int32_t from = regions.border[i].from;
    if (corner[static_cast<std::size_t>(from)] == 0) {
      continue;
    }
    const std::int32_t to = follow(regions.border, next, corner, i, dropped);
    for (const std::int32_t v : dropped) {
      seen[static_cast<std::size_t>(v)] = 1;
      // Both neighbours of a border must decide alike: the ends in one order.
      if (from == to ||
          distance_to_segment(point(v), point(std::min(from, to)), point(std::max(from, to))) > straight_m) {
        promoted.push_back(v);
      }
    }
  }
  for (const BorderEdge& edge : regions.border) {  // loops without any corner
    if (corner[static_cast<std::size_t>(edge.from)] == 0 && seen[static_cast<std::size_t>(edge.from)] == 0) {
      promoted.push_back(edge.from);
    }
  }
  for (const std::int32_t v : promoted) {
    corner[static_cast<std::size_t>(v)] = 1;
  }
  return !promoted.empty();
}

}  // namespace

FacetRegions join_facets(const FacetSurface& surface) {
  const std::vector<HalfEdge> edges = sorted_half_edges(surface);
  const auto same_surface = [&](std::int32_t a, std::int32_t b) {
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    return surface.plane[i] == surface.plane[j] && surface.kind[i] == surface.kind[j] &&
           surface.storey[i] == surface.storey[j];
  };
  DisjointSets sets(surface.facets());
  for_each_edge(edges, [&](std::size_t first, std::size_t last) {
    if (last - first == 2 && edges[first].forward != edges[first + 1].forward &&
        same_surface(edges[first].facet, edges[first + 1].facet)) {
      sets.unite(edges[first].facet, edges[first + 1].facet);
    }
  });
  FacetRegions out;
  out.region_of.assign(surface.facets(), -1);
  for (std::size_t f = 0; f < surface.facets(); ++f) {
    const std::int32_t root = sets.root(static_cast<std::int32_t>(f));  // the lowest facet: numbered already
    out.region_of[f] =
        static_cast<std::size_t>(root) == f ? out.count++ : out.region_of[static_cast<std::size_t>(root)];
  }
  for_each_edge(edges, [&](std::size_t first, std::size_t last) {
    const auto region = [&](std::size_t i) {
      return out.region_of[static_cast<std::size_t>(edges[i].facet)];
    };
    if (last - first == 2 && edges[first].forward != edges[first + 1].forward &&
        region(first) == region(first + 1)) {
      return;
    }
    for (std::size_t i = first; i < last; ++i) {
      const HalfEdge& e = edges[i];
      out.border.push_back({region(i), e.forward ? e.lo : e.hi, e.forward ? e.hi : e.lo, e.carrier});
    }
  });
  std::sort(out.border.begin(), out.border.end(), [](const BorderEdge& a, const BorderEdge& b) {
    return std::tie(a.region, a.from, a.to) < std::tie(b.region, b.from, b.to);
  });
  return out;
}

std::vector<std::uint8_t> find_corners(const FacetSurface& surface, const FacetRegions& regions,
                                       double straight_m) {
  struct Touch {
    std::int32_t vertex, region;
    std::int64_t carrier;
  };
  std::vector<Touch> touches;
  for (const BorderEdge& e : regions.border) {
    touches.push_back({e.from, e.region, e.carrier});
    touches.push_back({e.to, e.region, e.carrier});
  }
  std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) {
    return std::tie(a.vertex, a.region, a.carrier) < std::tie(b.vertex, b.region, b.carrier);
  });
  std::vector<std::uint8_t> corner(surface.vertices.size(), 0);
  for (std::size_t first = 0; first < touches.size();) {
    std::size_t last = first;
    bool turns = false;
    while (last < touches.size() && touches[last].vertex == touches[first].vertex) {
      turns = turns || touches[last].carrier != touches[first].carrier;
      ++last;
    }
    // A border that runs straight through touches its two regions twice each.
    const bool straight = !turns && last - first == 4 && touches[first].region == touches[first + 1].region &&
                          touches[first + 2].region == touches[first + 3].region &&
                          touches[first].region != touches[first + 2].region;
    corner[static_cast<std::size_t>(touches[first].vertex)] = straight ? 0 : 1;
    first = last;
  }
  const std::vector<std::int32_t> next = successors(regions.border);
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (next[i] < 0) {
      corner[static_cast<std::size_t>(regions.border[i].to)] = 1;
    }
  }
  while (promote_crooked(surface, regions, next, straight_m, corner)) {
  }
  return corner;
}

std::vector<BorderSegment> straighten(const FacetRegions& regions, const std::vector<std::uint8_t>& corner) {
  const std::vector<std::int32_t> next = successors(regions.border);
  std::vector<BorderSegment> segments;
  std::vector<std::int32_t> dropped;
  for (std::size_t i = 0; i < regions.border.size(); ++i) {
    const BorderEdge& edge = regions.border[i];
    if (corner[static_cast<std::size_t>(edge.from)] != 0) {
      segments.push_back({edge.region, {edge.from, follow(regions.border, next, corner, i, dropped)}});
    }
  }
  return segments;
}

}  // namespace roomcut

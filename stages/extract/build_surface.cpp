// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/build_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "common/mesh/self_intersections.h"
#include "stages/extract/column_surface.h"
#include "stages/extract/touching_knots.h"

namespace roomcut::extract {

namespace {

// Rounds of putting back what touches: one surface at each place, then all there, then all of the model.
// Where nothing touches, the surfaces of the regions that cut each other go back.
constexpr int kSingleRounds = 12;
constexpr int kMostRounds = 24;

SurfaceAreas measure_areas(const TriangleMesh& mesh) {
  SurfaceAreas areas;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto kind = static_cast<SurfaceKind>(mesh.kind[t]);
    double& sum = kind == SurfaceKind::kFloor     ? areas.floor
                  : kind == SurfaceKind::kCeiling ? areas.ceiling
                                                  : areas.wall;
    sum += triangle_area(mesh, t);
  }
  return areas;
}

/// The facets enclose just the runs. Merged, they do but for what was snapped: the vertices of one wall lie
/// within kPlanSnap_m of its line, those of a floor or ceiling that is no level within the weld of its plane;
/// which of them a triangle joins moves its surface by less than that.
std::string volume_fault(const BuiltSurface& built, double facets_m3, double weld_m) {
  constexpr double kRounding = 1e-9;
  const double rounding = kRounding * built.empty_m3;
  const double snap = kPlanSnap_m * built.areas.wall + weld_m * (built.areas.floor + built.areas.ceiling);
  if (std::abs(facets_m3 - built.empty_m3) <= rounding &&
      std::abs(built.check.volume_m3 - facets_m3) <= rounding + snap) {
    return "";
  }
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(),
                "its volume is %.9f m3, that of its facets %.9f m3, but the empty cells have %.9f m3",
                built.check.volume_m3, facets_m3, built.empty_m3);
  return text.data();
}

/// One attempt, and what it was made of.
struct Attempt {
  Columns columns;
  WeldedColumns welded;
  ColumnSurface surface;
};

void check(const Attempt& attempt, double weld_m, BuiltSurface& built) {
  built.empty_m3 = attempt.surface.volume_m3;
  built.merged = merge_facets(attempt.surface.facets);
  built.areas = measure_areas(built.merged.mesh);
  built.check = check_mesh(built.merged.mesh);
  built.fault = built.merged.fault;
  for (const std::string& more :
       {describe_faults(built.check), volume_fault(built, volume(attempt.surface.facets), weld_m)}) {
    if (!more.empty()) {
      built.fault += (built.fault.empty() ? "" : "; ") + more;
    }
  }
}

/// A level face with a surface at a place where the model touches itself, and the volume between the two.
struct Candidate {
  std::int32_t place;
  double moved_m3;
  std::size_t level_face;
};

/// Calls visit(run, end, place, knot) for the corners of all floors and ceilings.
template <class Visit>
void for_each_corner(const Attempt& attempt, const Visit& visit) {
  for (std::size_t r = 0; r < attempt.columns.runs.size(); ++r) {
    const Run& run = attempt.columns.runs[r];
    const auto first =
        static_cast<std::size_t>(attempt.welded.corner_offset[static_cast<std::size_t>(run.face)]);
    const auto knots = static_cast<std::size_t>(attempt.welded.knot_offset[r]);
    for (std::size_t c = 0; c < attempt.welded.corners(static_cast<std::size_t>(run.face)); ++c) {
      visit(run, run.lower, attempt.welded.corner_place[first + c], attempt.welded.lower[knots + c]);
      visit(run, run.upper, attempt.welded.corner_place[first + c], attempt.welded.upper[knots + c]);
    }
  }
}

/// The surfaces that have a corner at one of the knots; if there is none, those over and under them.
std::vector<Candidate> candidates_at(const EndHeights& heights, const Attempt& attempt,
                                     const std::vector<std::int32_t>& knots) {
  const CellComplex& complex = heights.complex();
  std::vector<std::uint8_t> touching(attempt.welded.places.size(), 0);
  std::vector<Candidate> at, over;
  const auto is_in = [&](std::int32_t knot) { return std::binary_search(knots.begin(), knots.end(), knot); };
  for_each_corner(attempt, [&](const Run&, const RunEnd&, std::int32_t place, std::int32_t knot) {
    touching[static_cast<std::size_t>(place)] |= is_in(knot) ? 1 : 0;
  });
  for_each_corner(attempt, [&](const Run& run, const RunEnd& end, std::int32_t place, std::int32_t knot) {
    if (end.surface >= 0 && touching[static_cast<std::size_t>(place)] != 0) {
      const auto face = static_cast<std::size_t>(run.face);
      const auto level = static_cast<std::size_t>(end.level);
      const double off = std::abs(heights.z(end, complex.centroid(face)) - complex.levels[level]);
      const Candidate candidate{place, complex.area(face) * off, complex.level_face(face, level)};
      (is_in(knot) ? at : over).push_back(candidate);
    }
  });
  std::vector<Candidate>& found = at.empty() ? over : at;
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.place, a.moved_m3, a.level_face) < std::tie(b.place, b.moved_m3, b.level_face);
  });
  return found;
}

/// At each place where the model touches itself puts back the surface that moves least by it, or all there.
/// Returns whether there were any.
bool put_back_at(const EndHeights& heights, const Attempt& attempt, bool all, LevelSurfaces& surfaces,
                 std::vector<std::size_t>& put_back) {
  const std::vector<Candidate> candidates =
      candidates_at(heights, attempt, touching_knots(attempt.surface.facets));
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::int32_t& own = surfaces.of_face[candidates[i].level_face];
    const bool least = i == 0 || candidates[i - 1].place != candidates[i].place;
    if (own >= 0 && (all || least)) {
      own = -1;
      put_back.push_back(candidates[i].level_face);
    }
  }
  return !candidates.empty();
}

/// The surfaces of regions that could not be triangulated or cut others, ascending.
std::vector<std::int32_t> faulty_surfaces(const CellComplex& complex, const MergedSurface& merged) {
  std::vector<std::size_t> regions;
  for (std::size_t r = 0; r < merged.regions.size(); ++r) {
    if (merged.regions[r].triangles == 0) {
      regions.push_back(r);
    }
  }
  for (const std::size_t t : self_intersecting_triangles(merged.mesh)) {
    regions.push_back(static_cast<std::size_t>(merged.mesh.region[t]));
  }
  std::vector<std::int32_t> surfaces;
  for (const std::size_t r : regions) {
    if (const std::int32_t surface = surface_of_plane(complex, merged.regions[r].plane); surface >= 0) {
      surfaces.push_back(surface);
    }
  }
  std::sort(surfaces.begin(), surfaces.end());
  return surfaces;
}

/// Puts back all faces of some surfaces. Returns whether there were any.
bool put_back_whole(const std::vector<std::int32_t>& whole, LevelSurfaces& surfaces,
                    std::vector<std::size_t>& put_back) {
  const std::size_t before = put_back.size();
  for (std::size_t i = 0; i < surfaces.of_face.size(); ++i) {
    if (surfaces.of_face[i] >= 0 && std::binary_search(whole.begin(), whole.end(), surfaces.of_face[i])) {
      surfaces.of_face[i] = -1;
      put_back.push_back(i);
    }
  }
  return put_back.size() > before;
}

void put_back_all(LevelSurfaces& surfaces, std::vector<std::size_t>& put_back) {
  for (std::size_t i = 0; i < surfaces.of_face.size(); ++i) {
    if (surfaces.of_face[i] >= 0) {
      surfaces.of_face[i] = -1;
      put_back.push_back(i);
    }
  }
}

}  // namespace

BuiltSurface build_surface(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                           const Storeys& storeys, LevelSurfaces& surfaces) {
  const EndHeights heights(complex, surfaces);
  std::vector<std::size_t> put_back;
  for (int round = 0;; ++round) {
    Attempt attempt;
    attempt.columns = columns_of(heights, label, storeys);
    const std::vector<std::size_t> slabs = keep_slabs(complex, surfaces, attempt.columns);
    put_back.insert(put_back.end(), slabs.begin(), slabs.end());
    attempt.welded = weld_columns(heights, attempt.columns);
    attempt.surface = surface_of_columns(heights, attempt.columns, attempt.welded);
    const bool at_surfaces =
        std::any_of(attempt.columns.runs.begin(), attempt.columns.runs.end(),
                    [](const Run& run) { return run.lower.surface >= 0 || run.upper.surface >= 0; });
    BuiltSurface built;
    check(attempt, at_surfaces ? weld_distance(complex) : 0, built);
    if (built.fault.empty() || !at_surfaces) {
      std::sort(put_back.begin(), put_back.end());
      built.put_back = std::move(put_back);
      return built;
    }
    if (round >= kMostRounds ||
        (!put_back_at(heights, attempt, round >= kSingleRounds, surfaces, put_back) &&
         !put_back_whole(faulty_surfaces(complex, built.merged), surfaces, put_back))) {
      put_back_all(surfaces, put_back);
    }
  }
}

}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/build_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "stages/extract/column_surface.h"
#include "stages/extract/touching_knots.h"

namespace roomcut::extract {

namespace {

// Rounds of putting back what touches: one surface at each place, then all there, then all of the model.
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

/// A level face with a surface that has a corner at a knot, and the volume between the two.
struct Candidate {
  std::int32_t knot;
  double moved_m3;
  std::size_t level_face;
};

std::vector<Candidate> candidates_at(const EndHeights& heights, const Attempt& attempt,
                                     const std::vector<std::int32_t>& knots) {
  const CellComplex& complex = heights.complex();
  std::vector<Candidate> found;
  const auto add = [&](std::size_t face, const RunEnd& end, std::int32_t knot) {
    if (end.surface >= 0 && std::binary_search(knots.begin(), knots.end(), knot)) {
      const auto level = static_cast<std::size_t>(end.level);
      const double off = std::abs(heights.z(end, complex.centroid(face)) - complex.levels[level]);
      found.push_back({knot, complex.area(face) * off, complex.level_face(face, level)});
    }
  };
  for (std::size_t r = 0; r < attempt.columns.runs.size(); ++r) {
    const Run& run = attempt.columns.runs[r];
    for (auto k = static_cast<std::size_t>(attempt.welded.knot_offset[r]);
         k < static_cast<std::size_t>(attempt.welded.knot_offset[r + 1]); ++k) {
      add(static_cast<std::size_t>(run.face), run.lower, attempt.welded.lower[k]);
      add(static_cast<std::size_t>(run.face), run.upper, attempt.welded.upper[k]);
    }
  }
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.knot, a.moved_m3, a.level_face) < std::tie(b.knot, b.moved_m3, b.level_face);
  });
  return found;
}

/// At each of the knots puts back the surface that moves least by it, or all there. Returns whether there
/// were any.
bool put_back_at(const EndHeights& heights, const Attempt& attempt, bool all, LevelSurfaces& surfaces,
                 std::vector<std::size_t>& put_back) {
  const std::vector<Candidate> candidates =
      candidates_at(heights, attempt, touching_knots(attempt.surface.facets));
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::int32_t& own = surfaces.of_face[candidates[i].level_face];
    const bool least = i == 0 || candidates[i - 1].knot != candidates[i].knot;
    if (own >= 0 && (all || least)) {
      own = -1;
      put_back.push_back(candidates[i].level_face);
    }
  }
  return !candidates.empty();
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
    if (round >= kMostRounds || !put_back_at(heights, attempt, round >= kSingleRounds, surfaces, put_back)) {
      put_back_all(surfaces, put_back);
    }
  }
}

}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/partition.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>

#include "common/errors/codes.h"
#include "common/plan/plan_complex.h"
#include "common/plan/segment_inserter.h"
#include "stages/partition/creases.h"
#include "stages/partition/prune.h"
#include "stages/partition/shared_edges.h"

namespace roomcut::partition {

namespace {

constexpr double kShort_m = 0.5;       // shorter lines are sides of niches and columns
constexpr double kLeastReach_m = 0.1;  // their ends are good to this

CellComplex::Line complex_line(const WallLine& wall, std::size_t layers) {
  if (!(wall.length() > kPlanSnap_m)) {
    throw StageError(errors::kLinesDegenerate, "wall line " + wall.id, "both ends are equal",
                     "delete the line or move an end");
  }
  CellComplex::Line line{wall.id, wall.line(), 0, 0, {}, -1};
  std::tie(line.t0, line.t1) = std::minmax({line.line.along(wall.a), line.line.along(wall.b)});
  for (const int slice : wall.levels.value_or(std::vector<int>{})) {
    if (slice < 0 || static_cast<std::size_t>(slice) >= layers) {
      throw StageError(errors::kLinesProperty, "wall line " + wall.id,
                       "levels: there is no wall slice " + std::to_string(slice) + " (the scan has 0 ... " +
                           std::to_string(layers - 1) + ")",
                       "set levels to null for all slices");
    }
    line.layers.push_back(slice);
  }
  std::sort(line.layers.begin(), line.layers.end());
  line.layers.erase(std::unique(line.layers.begin(), line.layers.end()), line.layers.end());
  return line;
}

/// Indices of the lines, strongest first. A line drawn by hand has no counted support: its length stands for
/// it.
std::vector<std::int32_t> by_falling_support(const std::vector<WallLine>& lines) {
  std::vector<std::int32_t> order(lines.size());
  std::iota(order.begin(), order.end(), 0);
  const auto strength = [&](std::int32_t i) {
    return lines[i].support_m > 0 ? lines[i].support_m : lines[i].length();
  };
  std::sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) {
    const double a = strength(i);
    const double b = strength(j);
    return a != b ? a > b : lines[i].id < lines[j].id;
  });
  return order;
}

void bounding_box(const WallLines& lines, double margin, Vec2& low, Vec2& high) {
  low = lines.bbox_min;
  high = lines.bbox_max;
  for (const WallLine& line : lines.lines) {
    low = low.cwiseMin(line.a).cwiseMin(line.b);
    high = high.cwiseMax(line.a).cwiseMax(line.b);
  }
  low.array() -= margin;
  high.array() += margin;
}

/// How far a line cuts on beyond its support. What is short is known to be short, its ends are seen; a wall
/// whose ends hide behind furniture may go on.
double reach_of(const CellComplex::Line& line, double extend_m) {
  const double length = line.t1 - line.t0;
  return length < kShort_m ? std::min(extend_m, std::max(kLeastReach_m, length)) : extend_m;
}

std::vector<PlanSegment> reaches(const std::vector<CellComplex::Line>& lines, double extend_m) {
  std::vector<PlanSegment> reach;
  for (const CellComplex::Line& line : lines) {
    const double beyond = reach_of(line, extend_m);
    reach.push_back({line.line, line.t0 - beyond, line.t1 + beyond});
  }
  return reach;
}

std::string crease_name(std::size_t i) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "crease%04zu", i + 1);
  return text.data();
}

/// Adds the creases of the complex's planes: to its lines, after the wall lines, and to the reaches and the
/// order.
void add_creases(CellComplex& complex, std::vector<PlanSegment>& reach, std::vector<std::int32_t>& order) {
  const std::vector<Crease> creases = find_creases(complex, reach);
  for (std::size_t i = 0; i < creases.size(); ++i) {
    const Crease& crease = creases[i];
    CellComplex::Line line{crease_name(i), crease.segment.line, crease.segment.t0, crease.segment.t1, {},
                           crease.plane};
    if (crease.layer >= 0) {
      line.layers.push_back(crease.layer);
    }
    order.push_back(static_cast<std::int32_t>(complex.lines.size()));
    complex.lines.push_back(std::move(line));
    reach.push_back(crease.segment);
  }
}

std::vector<std::string> lines_without_edge(const CellComplex& complex) {
  std::vector<bool> has_edge(complex.lines.size(), false);
  for (const CellComplex::Edge& edge : complex.edges) {
    if (edge.line >= 0) {
      has_edge[edge.line] = true;
    }
  }
  std::vector<std::string> without;
  for (std::size_t i = 0; i < has_edge.size(); ++i) {
    if (!has_edge[i] && complex.lines[i].plane < 0) {
      without.push_back(complex.lines[i].wall_id);
    }
  }
  return without;
}

void check_budget(std::size_t faces, std::size_t layers, const PartitionParams& params) {
  if (faces * layers > static_cast<std::size_t>(params.max_cells)) {
    throw StageError(
        errors::kTooComplex, "partition",
        "more than " + std::to_string(params.max_cells) + " cells (" + std::to_string(faces) +
            " plan faces in " + std::to_string(layers) + " layers)",
        "see whether detect_lines found clutter; lower partition.extend_m or raise partition.max_cells");
  }
}

}  // namespace

Partition partition(const WallLines& lines, const std::vector<double>& levels, const PartitionParams& params,
                    const Slopes& slopes) {
  if (lines.lines.empty()) {
    throw StageError(errors::kNoCells, "partition", "there is no wall line to cut the plan with",
                     "see detect_lines' messages, or add lines by hand (make edit-lines)");
  }
  Partition result;
  CellComplex& complex = result.complex;
  complex.frame = lines.frame;
  complex.levels = levels;
  complex.steps = slopes.steps;
  complex.steps.resize(levels.size());
  complex.planes = slopes.planes;
  for (const WallLine& wall : lines.lines) {
    complex.lines.push_back(complex_line(wall, complex.layers()));
  }
  Vec2 low;
  Vec2 high;
  bounding_box(lines, params.margin_m, low, high);
  Subdivision plan(low, high);
  SegmentInserter inserter(plan);
  std::vector<std::int32_t> order = by_falling_support(lines.lines);
  std::vector<PlanSegment> reach = reaches(complex.lines, params.extend_m);
  add_creases(complex, reach, order);
  for (const std::int32_t i : order) {
    inserter.insert(reach[i], i);
    check_budget(plan.face_start.size(), complex.layers(), params);
  }
  result.faces_before_pruning = plan.face_start.size();
  assign_shared_edges(plan, reach, inserter.shared(), order);
  if (params.prune) {
    prune(plan, reach, order);
  }
  set_plan(plan, plan.faces_in_tree_order(), complex);
  result.without_edge = lines_without_edge(complex);
  return result;
}

}  // namespace roomcut::partition

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/element_scores.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomcut::evaluate {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLevel = 0.3 * kDegree, kUpright = 80 * kDegree;  // from level
constexpr double kNear = 0.02;                                     // [m]
constexpr double kFacing = 15 * kDegree;                           // of a niche's faces
constexpr double kOnFace = 1e-3;                         // a niche's faces lie on its box so exactly [m]
constexpr double kRaster = 0.05;                         // of pillars [m]
constexpr double kSolid = 0.9;                           // of the height of a pillar
constexpr double kLowest = 0.5;                          // rooms have no pillars where they are lower [m]
constexpr double kSmallest = 0.01, kLargest = 1.0;       // plan of a pillar [m^2]
constexpr double kHeightRaster = 0.2, kOffHeight = 0.3;  // [m]
constexpr int kColumnLines = 12;                         // through a column, each way

struct Box2 {
  Vec2 lo, hi;
};

Box2 box_of(const std::vector<Vec2>& polygon) {
  Box2 box{polygon.front(), polygon.front()};
  for (const Vec2& p : polygon) box = {box.lo.cwiseMin(p), box.hi.cwiseMax(p)};
  return box;
}

/// Whether p lies in the polygon or on its border.
bool holds(const std::vector<Vec2>& polygon, const Vec2& p) {
  if (in_polygon(polygon, p.x(), p.y())) return true;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2 ab = polygon[(i + 1) % polygon.size()] - a;
    const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    if ((p - a - t * ab).norm() <= kOnFace) return true;
  }
  return false;
}

std::vector<Interval> enclosed_at(const Columns& mesh, const Vec2& p) {
  std::vector<Crossing> crossings;
  std::vector<Interval> parts;
  mesh.crossings(p.x(), p.y(), crossings);
  enclosed(crossings, -1, parts);
  return parts;
}

/// What a mesh encloses over p between a room's floor and ceiling.
std::vector<Interval> enclosed_in(const TruthRoom& room, const Columns& mesh, const Vec2& p) {
  std::vector<Interval> here;
  clip(enclosed_at(mesh, p), room.floor, room.ceiling, here);
  return here;
}

/// The part of `within` over p that the mesh does not enclose.
double solid_length(const Columns& mesh, const Vec2& p, const std::vector<Interval>& within) {
  return total_length(within) - overlap(within, enclosed_at(mesh, p));
}

std::optional<double> median(std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double solid_share(const DescribedColumn& column, const Columns& model) {
  const Box2 box = box_of(column.polygon);
  const std::vector<Interval> height{{column.z0, column.z1}};
  double solid = 0;
  int lines = 0;
  for (int i = 0; i < kColumnLines; ++i) {
    for (int j = 0; j < kColumnLines; ++j) {
      const Vec2 p = box.lo + Vec2((i + 0.5) / kColumnLines * (box.hi - box.lo).x(),
                                   (j + 0.5) / kColumnLines * (box.hi - box.lo).y());
      if (!in_polygon(column.polygon, p.x(), p.y())) continue;
      ++lines;
      solid += solid_length(model, p, height) / (column.z1 - column.z0);
    }
  }
  return lines > 0 ? solid / lines : 0;
}

/// The plan of one room: where it is free in both, where only in the truth, and where in neither.
class PillarRaster {
 public:
  enum class Cell : std::uint8_t { kWall, kFree, kPillar, kSeen };

  PillarRaster(const TruthRoom& room, const Columns& truth, const Columns& model)
      : box_(box_of(room.polygon)),
        nx_(static_cast<int>((box_.hi - box_.lo).x() / kRaster) + 3),
        ny_(static_cast<int>((box_.hi - box_.lo).y() / kRaster) + 3),
        cells_(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), Cell::kWall) {
    tbb::parallel_for(1, ny_ - 1, [&](int y) {
      for (int x = 1; x + 1 < nx_; ++x) cell(x, y) = kind(room, truth, model, middle(x, y));
    });
  }

  std::size_t count_pillars() {
    std::size_t pillars = 0;
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        if (cell(x, y) == Cell::kPillar) pillars += stands_free(x, y) ? 1 : 0;
      }
    }
    return pillars;
  }

  double floor_m2() const {
    const auto walls = std::count(cells_.begin(), cells_.end(), Cell::kWall);
    return kRaster * kRaster * static_cast<double>(static_cast<std::ptrdiff_t>(cells_.size()) - walls);
  }

 private:
  Cell& cell(int x, int y) { return cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + x]; }
  Vec2 middle(int x, int y) const { return box_.lo + kRaster * Vec2(x - 0.5, y - 0.5); }

  static Cell kind(const TruthRoom& room, const Columns& truth, const Columns& model, const Vec2& p) {
    if (!in_polygon(room.polygon, p.x(), p.y())) return Cell::kWall;
    const std::vector<Interval> here = enclosed_in(room, truth, p);
    const double height = total_length(here);
    if (height < kLowest) return Cell::kWall;
    return solid_length(model, p, here) > kSolid * height ? Cell::kPillar : Cell::kFree;
  }

  /// Marks the pillar's cells as seen. With a wall or a column of the truth beside it, it is a part of that.
  bool stands_free(int x0, int y0) {
    std::vector<std::pair<int, int>> todo{{x0, y0}};
    cell(x0, y0) = Cell::kSeen;
    bool free = true;
    std::size_t size = 0;
    while (!todo.empty()) {
      const auto [x, y] = todo.back();
      todo.pop_back();
      ++size;
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          Cell& next = cell(x + dx, y + dy);
          free = free && next != Cell::kWall;
          if (next != Cell::kPillar) continue;
          next = Cell::kSeen;
          todo.emplace_back(x + dx, y + dy);
        }
      }
    }
    const double area = kRaster * kRaster * static_cast<double>(size);
    return free && area >= kSmallest && area < kLargest;
  }

  Box2 box_;
  int nx_, ny_;  // with a rim of walls
  std::vector<Cell> cells_;
};

}  // namespace

std::size_t ColumnScores::found() const {
  return static_cast<std::size_t>(
      std::count_if(columns.begin(), columns.end(), [](const Column& column) { return column.found(); }));
}

double NicheScores::area_m2() const {
  double sum = 0;
  for (const Niche& niche : niches) sum += niche.area_m2;
  return sum;
}

double NicheScores::near_m2() const {
  double sum = 0;
  for (const Niche& niche : niches) sum += niche.near_m2;
  return sum;
}

SlopeScores score_slopes(const SurfaceDistances& truth, const MeasuredSurface& truth_surface,
                         const MeasuredSurface& model_surface) {
  std::vector<std::size_t> sloped;
  SlopeScores out;
  double matched = 0;
  for (std::size_t i = 0; i < truth.samples.size(); ++i) {
    const double up = std::abs(truth_surface.all().unit_normal(truth.samples[i].triangle).z());
    if (!(truth.samples[i].area_m2 > 0) || up > std::cos(kLevel) || up < std::cos(kUpright)) continue;
    sloped.push_back(i);
    out.area_m2 += truth.samples[i].area_m2;
    matched += truth.match[i] >= Match::kClose ? truth.samples[i].area_m2 : 0;
  }
  if (sloped.empty()) return out;
  std::vector<std::pair<double, double>> angle_area(sloped.size());
  tbb::parallel_for(std::size_t{0}, sloped.size(), [&](std::size_t k) {
    const SurfaceSample& sample = truth.samples[sloped[k]];
    const Vec3& normal = truth_surface.all().unit_normal(sample.triangle);
    const auto nearest = model_surface.all().nearest(sample.point);
    const double cosine = normal.dot(model_surface.all().unit_normal(nearest.triangle));
    angle_area[k] = {std::acos(std::clamp(cosine, -1.0, 1.0)) / kDegree, sample.area_m2};
  });
  std::sort(angle_area.begin(), angle_area.end());
  const auto quantile = [&](double share) {
    double sum = 0;
    for (const auto& [angle, area] : angle_area) {
      sum += area;
      if (sum >= share * out.area_m2) return angle;
    }
    return angle_area.back().first;
  };
  out.angle_median_deg = quantile(0.5);
  out.angle_p95_deg = quantile(0.95);
  out.matched = matched / out.area_m2;
  return out;
}

NicheScores score_niches(const std::vector<DescribedNiche>& niches, const SurfaceDistances& truth,
                         const MeasuredSurface& truth_surface, const MeasuredSurface& model_surface) {
  NicheScores out;
  for (const DescribedNiche& niche : niches) {
    const Box2 box = box_of(niche.polygon);
    NicheScores::Niche score{niche.width_m, niche.depth_m, niche.solid, 0, 0};
    for (const SurfaceSample& sample : truth.samples) {
      const Vec3& p = sample.point;
      const bool here = sample.area_m2 > 0 && p.z() > niche.z0 - kOnFace && p.z() < niche.z1 + kOnFace &&
                        p.x() > box.lo.x() - kOnFace && p.x() < box.hi.x() + kOnFace &&
                        p.y() > box.lo.y() - kOnFace && p.y() < box.hi.y() + kOnFace &&
                        holds(niche.polygon, p.head<2>());
      if (!here) continue;
      const Vec3& normal = truth_surface.all().unit_normal(sample.triangle);
      score.area_m2 += sample.area_m2;
      if (model_surface.all().nearest_facing(p, kNear + 1e-9, normal, std::cos(kFacing)).triangle >= 0) {
        score.near_m2 += sample.area_m2;
      }
    }
    out.niches.push_back(score);
  }
  return out;
}

RoomHeights score_heights(const TruthRoom& room, const Columns& truth, const Columns& model) {
  std::vector<double> floors;
  std::vector<double> ceilings;
  if (room.polygon.empty()) return {};
  const Box2 box = box_of(room.polygon);
  for (double x = box.lo.x() + kHeightRaster / 2; x < box.hi.x(); x += kHeightRaster) {
    for (double y = box.lo.y() + kHeightRaster / 2; y < box.hi.y(); y += kHeightRaster) {
      if (!in_polygon(room.polygon, x, y)) continue;
      const std::vector<Interval> here = enclosed_in(room, truth, {x, y});
      if (here.empty()) continue;
      for (const Interval& part : enclosed_at(model, {x, y})) {
        const double floor = part.lo - here.front().lo;
        const double ceiling = part.hi - here.back().hi;
        if (std::abs(floor) < kOffHeight) floors.push_back(floor);
        if (std::abs(ceiling) < kOffHeight) ceilings.push_back(ceiling);
      }
    }
  }
  return {median(floors), median(ceilings)};
}

ColumnScores score_columns(const std::vector<DescribedColumn>& columns, const std::vector<TruthRoom>& rooms,
                           const Columns& truth, const Columns& model) {
  ColumnScores out;
  for (const DescribedColumn& column : columns) {
    out.columns.push_back({column.size_m, solid_share(column, model)});
  }
  for (const TruthRoom& room : rooms) {
    if (room.polygon.empty()) continue;
    PillarRaster raster(room, truth, model);
    out.floor_m2 += raster.floor_m2();
    out.false_pillars += raster.count_pillars();
  }
  return out;
}

}  // namespace roomcut::evaluate

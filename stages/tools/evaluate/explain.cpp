// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/explain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "common/cells/face_locator.h"
#include "common/random/counter_random.h"
#include "stages/tools/evaluate/invented.h"
#include "stages/tools/evaluate/lost_walls.h"

namespace roomcut::evaluate {

namespace {

constexpr double kRounding = 1e-6;   // of the truth's coordinates [m]
constexpr double kMisplaced = 0.10;  // farther from the truth's surface, a line or level is another one [m]

/// Distance in the plan from p to the nearest edge of a face that lies on a wall line; infinite without one.
double distance_to_lines(const CellComplex& complex, std::int32_t face, const Vec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::int32_t side : complex.edges_of(static_cast<std::size_t>(face))) {
    const CellComplex::Edge& edge = complex.edges[static_cast<std::size_t>(side)];
    if (edge.line < 0) {
      continue;
    }
    const Vec2& a = complex.vertices[static_cast<std::size_t>(edge.v0)];
    const Vec2 along = complex.vertices[static_cast<std::size_t>(edge.v1)] - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - a - t * along).norm());
  }
  return nearest;
}

struct RoomPart {
  std::int32_t room;
  std::size_t cell;
  double length;
};

// Lengths instead of volumes, of one row of columns.
struct RowSums {
  std::vector<std::pair<std::size_t, double>> cell_truth, cell_height;
  double truth = 0;
  std::array<double, kCauses> lost = {}, extra = {};
  std::vector<RoomPart> rooms;
  std::vector<InventedPart> invented;
};

class Comparison {
 public:
  Comparison(const ExplainInput& input, double spacing_m, std::uint64_t seed);
  Explanation run();

 private:
  struct Column {
    double x, y;
    std::int32_t face;
    std::vector<double> z;  // where the cells over each other end: per level
    std::vector<Crossing> crossings;
    std::vector<Interval> parts, model, ignored;  // empty in the truth, in the model; counted nowhere
  };
  void column_at(std::int64_t ix, std::int64_t iy, Column& column) const;
  void stack_cells(Column& column) const;
  void measure_cells(std::int64_t iy, RowSums& sums) const;
  void find_causes(std::int64_t iy, RowSums& sums) const;
  void judge_cell(const Column& column, std::size_t layer, const std::vector<Interval>& rooms,
                  RowSums& sums) const;
  void judge_opening(const Column& column, double lo, double hi, std::vector<Interval>& wrong,
                     RowSums& sums) const;
  void room_parts(const Column& column, std::vector<Interval>& prisms, RowSums& sums) const;
  Cause geometry(const Column& column, std::size_t layer, const Interval& wrong) const;
  void label_by_truth(const std::vector<RowSums>& rows);
  double iou(const std::vector<std::uint8_t>& label) const;
  void sum_rooms(const std::vector<RowSums>& rows, Explanation& out) const;

  const ExplainInput& input_;
  const CellComplex& complex_;
  FaceLocator locator_;
  double spacing_;
  std::uint64_t seed_;
  Vec2 lo_{0, 0};
  std::int64_t nx_ = 0, ny_ = 0;
  bool prisms_ = false;  // rooms are prisms, so that what lies in none is an opening
  double truth_m3_ = 0;
  std::vector<double> cell_m3_, cell_truth_m3_;
  std::vector<std::uint8_t> truth_label_;
};

Comparison::Comparison(const ExplainInput& input, double spacing_m, std::uint64_t seed)
    : input_(input),
      complex_(input.complex),
      locator_(input.complex),
      spacing_(spacing_m),
      seed_(seed),
      cell_m3_(input.complex.cells(), 0),
      cell_truth_m3_(input.complex.cells(), 0),
      truth_label_(input.complex.cells(), 0) {
  lo_ = input.box.lo.head<2>();
  Vec2 hi = input.box.hi.head<2>();
  for (const Vec2& p : complex_.vertices) {
    lo_ = lo_.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  nx_ = static_cast<std::int64_t>((hi.x() - lo_.x()) / spacing_) + 1;
  ny_ = static_cast<std::int64_t>((hi.y() - lo_.y()) / spacing_) + 1;
  for (const TruthRoom& room : input.rooms) {
    prisms_ = prisms_ || room.body < 0;
  }
}

void Comparison::column_at(std::int64_t ix, std::int64_t iy, Column& column) const {
  const auto counter = static_cast<std::uint64_t>(2 * ix);
  const double jx = random_unit(seed_, static_cast<std::uint64_t>(iy), counter);
  const double jy = random_unit(seed_, static_cast<std::uint64_t>(iy), counter + 1);
  column.x = lo_.x() + (static_cast<double>(ix) + jx) * spacing_;
  column.y = lo_.y() + (static_cast<double>(iy) + jy) * spacing_;
  column.face = locator_.face_at({column.x, column.y});
  stack_cells(column);
  input_.truth.crossings(column.x, column.y, column.crossings);
  enclosed(column.crossings, -1, column.parts);
  std::vector<Crossing> crossings;
  input_.model.crossings(column.x, column.y, crossings);
  enclosed(crossings, -1, column.model);
  input_.ignored.at(column.x, column.y, column.parts, column.ignored);
}

/// Cells end at the surfaces that stand in place of their levels; one that is pushed aside has no height.
void Comparison::stack_cells(Column& column) const {
  column.z = complex_.levels;
  if (column.face < 0 || input_.surfaces.of_face.empty()) {
    return;
  }
  for (std::size_t l = 0; l < column.z.size(); ++l) {
    const std::int32_t surface =
        input_.surfaces.of_face[complex_.level_face(static_cast<std::size_t>(column.face), l)];
    if (surface >= 0) {
      column.z[l] = input_.surfaces.surfaces[static_cast<std::size_t>(surface)].height({column.x, column.y});
    }
    column.z[l] = l > 0 ? std::max(column.z[l], column.z[l - 1]) : column.z[l];
  }
}

void Comparison::measure_cells(std::int64_t iy, RowSums& sums) const {
  Column column;
  std::vector<Interval> inside;
  std::vector<Interval> ignored;
  for (std::int64_t ix = 0; ix < nx_; ++ix) {
    column_at(ix, iy, column);
    sums.truth += total_length(column.parts);
    if (column.face < 0) {
      continue;
    }
    for (std::size_t k = 0; k < complex_.layers(); ++k) {
      const std::size_t cell = complex_.cell(static_cast<std::size_t>(column.face), k);
      clip(column.parts, column.z[k], column.z[k + 1], inside);
      sums.cell_truth.emplace_back(cell, total_length(inside));
      clip(column.ignored, column.z[k], column.z[k + 1], ignored);
      sums.cell_height.emplace_back(cell, column.z[k + 1] - column.z[k] - total_length(ignored));
    }
  }
}

void Comparison::label_by_truth(const std::vector<RowSums>& rows) {
  const double area = spacing_ * spacing_;
  for (const RowSums& row : rows) {
    truth_m3_ += area * row.truth;
    for (const auto& [cell, length] : row.cell_truth) {
      cell_truth_m3_[cell] += area * length;
    }
    for (const auto& [cell, length] : row.cell_height) {
      cell_m3_[cell] += area * length;
    }
  }
  for (std::size_t cell = 0; cell < truth_label_.size(); ++cell) {
    truth_label_[cell] = cell_truth_m3_[cell] > 0.5 * cell_m3_[cell] ? 1 : 0;
  }
}

double Comparison::iou(const std::vector<std::uint8_t>& label) const {
  double common = 0;
  double extra = 0;
  for (std::size_t cell = 0; cell < label.size(); ++cell) {
    if (is_empty(label, cell)) {
      common += cell_truth_m3_[cell];
      extra += cell_m3_[cell] - cell_truth_m3_[cell];
    }
  }
  return truth_m3_ + extra > 0 ? common / (truth_m3_ + extra) : 0;
}

Cause Comparison::geometry(const Column& column, std::size_t layer, const Interval& wrong) const {
  const double lo = column.z[layer];
  const double hi = column.z[layer + 1];
  const bool at_floor = wrong.lo <= lo + kRounding;
  const bool at_ceiling = wrong.hi >= hi - kRounding;
  // Wrong from floor to ceiling, but for a level that is slightly off: the truth has a wall in this cell.
  const bool full = hi - lo - wrong.length() <= std::min(kMisplaced, 0.5 * (hi - lo));
  const double z = full ? 0.5 * (lo + hi) : (at_floor ? wrong.hi : wrong.lo);
  const Vec3 p(column.x, column.y, z);
  const MeasuredSurface& surface = input_.truth_surface;
  const MeshTree::Hit hit = surface.all().nearest(p);
  if (hit.triangle >= 0 && slope_class(surface.all().unit_normal(hit.triangle)) == SlopeClass::kSloped) {
    return Cause::kSloped;
  }
  if (!full) {
    const bool near_level = (at_floor || at_ceiling) && wrong.length() <= kMisplaced;
    return near_level ? Cause::kLevelsMisplaced : Cause::kLevelsMissing;
  }
  const double to_wall = surface.of(SlopeClass::kWall).nearest(p, kMisplaced).distance;
  const double to_line = distance_to_lines(complex_, column.face, {column.x, column.y});
  return to_wall + to_line <= kMisplaced ? Cause::kLinesMisplaced : Cause::kLinesMissing;
}

/// What an opening makes of a solid cell: takes from `wrong` what is empty in the model after all.
void Comparison::judge_opening(const Column& column, double lo, double hi, std::vector<Interval>& wrong,
                               RowSums& sums) const {
  std::vector<Interval> inside;
  std::vector<Interval> cut;
  clip(column.model, lo, hi, inside);
  subtract(inside, column.ignored, cut);
  if (total_length(cut) <= kRounding) {
    return;
  }
  sums.extra[static_cast<std::size_t>(Cause::kOpenings)] += total_length(cut) - overlap(cut, wrong);
  const std::vector<Interval> all = wrong;
  subtract(all, cut, wrong);
}

void Comparison::judge_cell(const Column& column, std::size_t layer, const std::vector<Interval>& rooms,
                            RowSums& sums) const {
  const std::size_t cell = complex_.cell(static_cast<std::size_t>(column.face), layer);
  const double lo = column.z[layer];
  const double hi = column.z[layer + 1];
  const bool empty = is_empty(input_.label, cell);
  std::vector<Interval> inside;
  clip(column.parts, lo, hi, inside);
  std::vector<Interval> wrong = inside;
  if (empty) {
    std::vector<Interval> solid;
    subtract({{lo, hi}}, inside, solid);
    subtract(solid, column.ignored, wrong);
  } else {
    judge_opening(column, lo, hi, wrong, sums);
  }
  auto& out = empty ? sums.extra : sums.lost;
  const bool by_label = (truth_label_[cell] != 0) != empty;
  const Cause label_cause = input_.label[cell] == Label::kUnknown ? Cause::kUnknown : Cause::kLabels;
  std::vector<Interval> one(1);
  for (const Interval& part : wrong) {
    one[0] = part;
    const double in_rooms = empty || !prisms_ ? part.length() : overlap(one, rooms);
    out[static_cast<std::size_t>(Cause::kOpenings)] += part.length() - in_rooms;
    if (in_rooms > 0) {
      const Cause cause = by_label ? label_cause : geometry(column, layer, part);
      out[static_cast<std::size_t>(cause)] += in_rooms;
      if (empty && by_label) {
        const Vec3 middle(column.x, column.y, 0.5 * (part.lo + part.hi));
        sums.invented.push_back({cell, middle, part.length()});
      }
    }
  }
}

void Comparison::room_parts(const Column& column, std::vector<Interval>& prisms, RowSums& sums) const {
  std::vector<std::int32_t> rooms;
  input_.finder.prisms_at(column.x, column.y, rooms);
  prisms.clear();
  const auto add = [&](std::int32_t room, const std::vector<Interval>& parts) {
    std::vector<Interval> inside;
    for (std::size_t k = 0; column.face >= 0 && k < complex_.layers(); ++k) {
      clip(parts, column.z[k], column.z[k + 1], inside);
      if (!inside.empty()) {
        sums.rooms.push_back(
            {room, complex_.cell(static_cast<std::size_t>(column.face), k), total_length(inside)});
      }
    }
  };
  for (const std::int32_t i : rooms) {
    const TruthRoom& room = input_.rooms[static_cast<std::size_t>(i)];
    prisms.push_back({room.floor, room.ceiling});
    add(i, {prisms.back()});
  }
  std::sort(prisms.begin(), prisms.end(), [](const Interval& a, const Interval& b) { return a.lo < b.lo; });
  std::vector<std::int32_t> bodies;
  for (const Crossing& crossing : column.crossings) {
    bodies.push_back(crossing.component);
  }
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  std::vector<Interval> parts;
  for (const std::int32_t body : bodies) {
    if (input_.finder.of_body(body) >= 0) {
      enclosed(column.crossings, body, parts);
      add(input_.finder.of_body(body), parts);
    }
  }
}

void Comparison::find_causes(std::int64_t iy, RowSums& sums) const {
  Column column;
  std::vector<Interval> prisms;
  for (std::int64_t ix = 0; ix < nx_; ++ix) {
    column_at(ix, iy, column);
    room_parts(column, prisms, sums);
    std::vector<Interval> inside;
    if (column.face >= 0) {
      clip(column.parts, column.z.front(), column.z.back(), inside);
    }
    sums.lost[static_cast<std::size_t>(Cause::kOutside)] += total_length(column.parts) - total_length(inside);
    for (std::size_t k = 0; column.face >= 0 && k < complex_.layers(); ++k) {
      judge_cell(column, k, prisms, sums);
    }
  }
}

void Comparison::sum_rooms(const std::vector<RowSums>& rows, Explanation& out) const {
  const double area = spacing_ * spacing_;
  std::vector<RoomPart> parts;
  for (const RowSums& row : rows) {
    parts.insert(parts.end(), row.rooms.begin(), row.rooms.end());
  }
  std::stable_sort(parts.begin(), parts.end(), [](const RoomPart& a, const RoomPart& b) {
    return std::tie(a.room, a.cell) < std::tie(b.room, b.cell);
  });
  out.rooms.resize(input_.rooms.size());
  std::vector<std::vector<std::size_t>> own(input_.rooms.size());
  for (std::size_t i = 0; i < parts.size();) {
    const RoomPart& first = parts[i];
    double length = 0;
    for (; i < parts.size() && parts[i].room == first.room && parts[i].cell == first.cell; ++i) {
      length += parts[i].length;
    }
    const auto room = static_cast<std::size_t>(first.room);
    out.rooms[room].volume_m3 += area * length;
    if (truth_label_[first.cell] != 0) {
      out.rooms[room].own_m3 += area * length;
      if (area * length > 0.5 * cell_truth_m3_[first.cell]) {
        own[room].push_back(first.cell);
      }
    }
  }
  for (std::size_t room = 0; room < own.size(); ++room) {
    out.rooms[room].own = evidence_of(complex_, input_.label, input_.terms, own[room]);
  }
}

Explanation Comparison::run() {
  std::vector<RowSums> rows(static_cast<std::size_t>(ny_));
  tbb::parallel_for(std::int64_t{0}, ny_,
                    [&](std::int64_t iy) { measure_cells(iy, rows[static_cast<std::size_t>(iy)]); });
  label_by_truth(rows);
  tbb::parallel_for(std::int64_t{0}, ny_,
                    [&](std::int64_t iy) { find_causes(iy, rows[static_cast<std::size_t>(iy)]); });
  Explanation out;
  out.bound_iou = iou(truth_label_);
  out.labels_iou = iou(input_.label);
  for (std::size_t cell = 0; cell < complex_.cells(); ++cell) {
    if (is_empty(input_.label, cell)) {
      out.empty_m3 += complex_.volume(cell);
    }
  }
  const double area = spacing_ * spacing_;
  for (const RowSums& row : rows) {
    for (std::size_t cause = 0; cause < kCauses; ++cause) {
      out.lost_m3[cause] += area * row.lost[cause];
      out.extra_m3[cause] += area * row.extra[cause];
    }
  }
  sum_rooms(rows, out);
  out.lost_walls = find_lost_walls(input_, locator_, truth_label_);
  std::vector<InventedPart> invented;
  for (const RowSums& row : rows) {
    invented.insert(invented.end(), row.invented.begin(), row.invented.end());
  }
  out.invented = find_invented(input_, invented, area);
  out.cell_m3 = std::move(cell_m3_);
  out.cell_truth_m3 = std::move(cell_truth_m3_);
  return out;
}

}  // namespace

double Explanation::invented_m3() const {
  double sum = 0;
  for (const InventedSpace& space : invented) {
    sum += space.volume_m3;
  }
  return sum;
}

Explanation explain(const ExplainInput& input, double spacing_m, std::uint64_t seed) {
  return Comparison(input, spacing_m, seed).run();
}

CellComplex moved(CellComplex complex, const Vec3& by) {
  for (Vec2& p : complex.vertices) {
    p += by.head<2>();
  }
  for (double& z : complex.levels) {
    z += by.z();
  }
  for (SlopedPlane& plane : complex.planes) {
    plane.c += by.z() - plane.gradient.dot(by.head<2>());
    for (Vec2& p : plane.outline) {
      p += by.head<2>();
    }
  }
  for (CellComplex::Line& line : complex.lines) {
    const Vec2 normal(std::cos(line.line.theta), std::sin(line.line.theta));
    const double along = normal.x() * by.y() - normal.y() * by.x();
    line.line.d += normal.dot(by.head<2>());
    line.t0 += along;
    line.t1 += along;
  }
  return complex;
}

LevelSurfaces moved(LevelSurfaces surfaces, const Vec3& by) {
  for (LevelSurface& surface : surfaces.surfaces) {
    surface.c += by.z() - surface.gradient.dot(by.head<2>());
  }
  return surfaces;
}

}  // namespace roomcut::evaluate

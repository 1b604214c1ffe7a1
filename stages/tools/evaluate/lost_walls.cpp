// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/lost_walls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace roomcut::evaluate {

namespace {

constexpr double kAlong =
    10 * std::numbers::pi / 180;     // a line that runs with a wall is turned by less [rad]
constexpr double kNamedShare = 0.1;  // of the missing area that a line must pass by

/// Collects the places of one lost wall.
class LostWallBuilder {
 public:
  LostWallBuilder(const ExplainInput& input, const FaceLocator& locator,
                  const std::vector<std::uint8_t>& truth_label, const ThinWallScores::Pair& pair)
      : input_(input), locator_(locator), truth_label_(truth_label) {
    wall_.a = pair.a;
    wall_.b = pair.b;
  }

  void add(const ThinWallScores::LostPlace& place) {
    wall_.area_m2 += place.area_m2;
    level_m2_ += place.wall ? 0 : place.area_m2;
    const std::int64_t at = locator_.cell_at(place.middle);
    if (at < 0) {
      return;
    }
    const auto cell = static_cast<std::size_t>(at);
    if (is_empty(truth_label_, cell)) {
      wall_.no_cell_m2 += place.area_m2;
      return;
    }
    cells_.push_back(cell);
    name_lines(input_.complex.face_of(cell), place);
  }

  Explanation::LostWall finish() {
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    wall_.cells = evidence_of(input_.complex, input_.label, input_.terms, cells_);
    wall_.slab = level_m2_ > 0.5 * wall_.area_m2;
    for (const auto& [id, area] : line_m2_) {
      if (area >= kNamedShare * wall_.area_m2) {
        wall_.wall_ids.push_back(id);
      }
    }
    return wall_;
  }

 private:
  void name_lines(std::size_t face, const ThinWallScores::LostPlace& place) {
    const CellComplex& complex = input_.complex;
    std::vector<std::string> ids;
    for (const std::int32_t side : complex.edges_of(face)) {
      const CellComplex::Edge& edge = complex.edges[static_cast<std::size_t>(side)];
      const Vec2 along = (complex.vertices[static_cast<std::size_t>(edge.v1)] -
                          complex.vertices[static_cast<std::size_t>(edge.v0)])
                             .normalized();
      if (edge.line >= 0 && place.wall && std::abs(along.dot(place.normal.head<2>())) < std::sin(kAlong)) {
        ids.push_back(complex.lines[static_cast<std::size_t>(edge.line)].wall_id);
      }
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    for (const std::string& id : ids) {
      line_m2_[id] += place.area_m2;
    }
  }

  const ExplainInput& input_;
  const FaceLocator& locator_;
  const std::vector<std::uint8_t>& truth_label_;
  Explanation::LostWall wall_{};
  double level_m2_ = 0;
  std::vector<std::size_t> cells_;
  std::map<std::string, double> line_m2_;
};

}  // namespace

Explanation::Evidence evidence_of(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                                  const DataTerms* terms, const std::vector<std::size_t>& cells) {
  Explanation::Evidence out;
  out.cells = cells.size();
  for (const std::size_t cell : cells) {
    const double volume = complex.volume(cell);
    out.volume_m3 += volume;
    out.empty_m3 += is_empty(label, cell) ? volume : 0;
    if (terms != nullptr) {
      out.evidence_m3 += terms->d_solid[cell] - terms->d_empty[cell];
      out.beta += volume * static_cast<double>(terms->beta[cell]);
      out.observed += volume * static_cast<double>(terms->observed[cell]);
    }
  }
  if (out.volume_m3 > 0) {
    out.beta /= out.volume_m3;
    out.observed /= out.volume_m3;
  }
  return out;
}

std::vector<Explanation::LostWall> find_lost_walls(const ExplainInput& input, const FaceLocator& locator,
                                                   const std::vector<std::uint8_t>& truth_label) {
  std::vector<Explanation::LostWall> out;
  for (const ThinWallScores::Pair& pair : input.thin.pairs) {
    const bool found = input.found[static_cast<std::size_t>(pair.a)] != 0 &&
                       input.found[static_cast<std::size_t>(pair.b)] != 0;
    if (!found || !ThinWallScores::is_lost(pair)) {
      continue;
    }
    LostWallBuilder builder(input, locator, truth_label, pair);
    for (const ThinWallScores::LostPlace& place : input.thin.lost) {
      if (place.a == pair.a && place.b == pair.b) {
        builder.add(place);
      }
    }
    out.push_back(builder.finish());
  }
  return out;
}

}  // namespace roomcut::evaluate

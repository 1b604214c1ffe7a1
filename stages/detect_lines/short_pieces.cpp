// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/short_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "stages/detect_lines/cell_groups.h"

namespace roomcut::detect_lines {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBeside_m = 0.7;      // from a line
constexpr double kShortest_m = 0.14;   // between the outermost cells
constexpr double kCovered = 0.6;       // share of a row
constexpr double kReaches = 0.6;       // share of the height
constexpr double kOther_rad = 0.6;     // a cell of a known direction so far off is not of the row
constexpr double kStep_m = 0.004;      // of the offsets tried
constexpr std::int32_t kTogether = 2;  // cells
constexpr double kSameLine_m = 0.015;  // a row so near a line, in its reach, is on it
constexpr double kSameLine_rad = 0.03;
constexpr double kReach_m = 1.5;
constexpr double kRow_m = 6;  // within this it takes over the line, with an interval of its own

Vec2 position(const WallCells& cells, std::uint32_t i) {
  return {cells.x[i], cells.y[i]};
}

/// Parts cells of one slice on one line where the gap is longer than `gap_m`.
std::vector<WallPiece> without_gaps(const WallCells& cells, CellIndices some, const Line2& line,
                                    double gap_m) {
  std::sort(some.begin(), some.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(line.along(position(cells, i)), i) < std::pair(line.along(position(cells, j)), j);
  });
  std::vector<WallPiece> pieces;
  for (const std::uint32_t i : some) {
    const double t = line.along(position(cells, i));
    if (pieces.empty() || t - pieces.back().t1 > gap_m)
      pieces.push_back({line, t, t, cells.slice[i], {}, -1});
    pieces.back().t1 = t;
    pieces.back().cells.push_back(i);
  }
  return pieces;
}

double covered_m(const WallCells& cells, const CellIndices& some) {
  double sum = 0;
  for (const std::uint32_t i : some) sum += cells.weight_m[i];
  return sum;
}

double reach_of(const WallCells& cells, const CellIndices& some) {
  double sum = 0, weight = 0;
  for (const std::uint32_t i : some) {
    sum += static_cast<double>(cells.weight_m[i]) * cells.coverage[i];
    weight += cells.weight_m[i];
  }
  return weight > 0 ? sum / weight : 0;
}

/// The cells that no line explains, as far as they are near one.
CellIndices unexplained(const WallCells& cells, const CellIndices& free,
                        const std::vector<LineCandidate>& lines, const PieceRules& rules) {
  CellIndices left;
  for (const std::uint32_t i : free) {
    const Vec2 p = position(cells, i);
    bool beside = false, explained = false;
    for (const LineCandidate& line : lines) {
      const double distance = std::abs(line.line.distance(p));
      if (distance > kBeside_m) continue;
      const double t = line.line.along(p);
      if (t < line.support.t0 - kBeside_m || t > line.support.t1 + kBeside_m) continue;
      beside = true;
      const bool on = t > line.support.t0 - rules.tau_m && t < line.support.t1 + rules.tau_m;
      explained = explained || (on && distance < rules.inlier_m);
    }
    if (beside && !explained) left.push_back(i);
  }
  return left;
}

/// The direction of the longest line beside a group.
std::optional<double> direction_beside(const WallCells& cells, const CellIndices& group,
                                       const std::vector<LineCandidate>& lines) {
  Vec2 middle = Vec2::Zero();
  for (const std::uint32_t i : group) middle += position(cells, i);
  middle /= static_cast<double>(group.size());
  const LineCandidate* longest = nullptr;
  for (const LineCandidate& line : lines) {
    const double t = line.line.along(middle);
    if (std::abs(line.line.distance(middle)) > kBeside_m || t < line.support.t0 - kBeside_m ||
        t > line.support.t1 + kBeside_m) {
      continue;
    }
    if (longest == nullptr || line.support.support_m > longest->support.support_m) longest = &line;
  }
  if (longest == nullptr) return std::nullopt;
  return longest->line.theta;
}

class RowSearch {
 public:
  RowSearch(const WallCells& cells, const PieceRules& rules)
      : cells_(cells), rules_(rules), half_m_(std::max(0.012, 1.5 * rules.noise_m)) {}

  /// The rows of a group, longest first, until none is long enough.
  void find(CellIndices group, double theta, std::vector<WallPiece>& pieces) const {
    for (;;) {
      WallPiece best;
      for (const double turn : {0.0, kPi / 2}) {
        const WallPiece row = longest_row(group, normalised(theta + turn, 0).theta);
        if (row.t1 - row.t0 > best.t1 - best.t0) best = row;
      }
      if (best.t1 - best.t0 < kShortest_m) return;
      const std::size_t before = group.size();
      const double corner = std::min(rules_.tau_m, 0.25 * (best.t1 - best.t0));  // the next row's as well
      for (const double kept : {corner, 0.0}) {
        if (group.size() == before) take_out(best, kept, group);
      }
      pieces.push_back(std::move(best));
    }
  }

 private:
  /// Takes a row's cells out of the group, but for those so near its ends.
  void take_out(const WallPiece& row, double ends_m, CellIndices& group) const {
    std::erase_if(group, [&](std::uint32_t i) {
      const double t = row.line.along(position(cells_, i));
      return std::abs(row.line.distance(position(cells_, i))) < half_m_ && t >= row.t0 + ends_m &&
             t <= row.t1 - ends_m;
    });
  }

  WallPiece longest_row(const CellIndices& group, double theta) const {
    CellIndices fitting;
    std::map<std::int64_t, double> votes;  // length by offset
    for (const std::uint32_t i : group) {
      if (cells_.boundary[i] != 0 && angle_between(cells_.theta[i], theta) > kOther_rad) continue;
      fitting.push_back(i);
      votes[step_of(i, theta)] += cells_.weight_m[i];
    }
    WallPiece best;
    const auto reach = static_cast<std::int64_t>(std::ceil(half_m_ / kStep_m));
    for (const auto& [step, own] : votes) {
      double sum = 0;
      for (auto near = votes.lower_bound(step - reach); near != votes.end() && near->first <= step + reach;
           ++near) {
        sum += near->second;
      }
      if (sum < kCovered * kShortest_m) continue;
      const WallPiece row = longest_at(fitting, {theta, (static_cast<double>(step) + 0.5) * kStep_m});
      if (row.t1 - row.t0 > best.t1 - best.t0 + 1e-9) best = row;
    }
    return best;
  }

  std::int64_t step_of(std::uint32_t i, double theta) const {
    return static_cast<std::int64_t>(std::floor(Line2{theta, 0}.distance(position(cells_, i)) / kStep_m));
  }

  WallPiece longest_at(const CellIndices& fitting, Line2 line) const {
    WallPiece best;
    for (int round = 0; round < 2; ++round) {  // the second one at the mean of the first one's cells
      CellIndices on;
      for (const std::uint32_t i : fitting) {
        if (std::abs(line.distance(position(cells_, i))) < half_m_) on.push_back(i);
      }
      best = {};
      for (WallPiece& piece : without_gaps(cells_, on, line, 2.5 * rules_.tau_m)) {
        const double length = piece.t1 - piece.t0;
        if (length <= best.t1 - best.t0 || covered_m(cells_, piece.cells) < kCovered * length ||
            reach_of(cells_, piece.cells) < kReaches) {
          continue;
        }
        best = std::move(piece);
      }
      if (best.cells.empty()) return best;
      double sum = 0, weight = 0;
      for (const std::uint32_t i : best.cells) {
        sum += cells_.area_m2[i] * line.distance(position(cells_, i));
        weight += cells_.area_m2[i];
      }
      line.d += sum / weight;
      best.line = line;
    }
    return best;
  }

  const WallCells& cells_;
  PieceRules rules_;
  double half_m_;  ///< farthest a cell lies off its row
};

/// Which of the lines, lengthened by `reach_m`, a row lies on; -1 = none.
int line_under(const WallPiece& row, const std::vector<LineCandidate>& lines, double reach_m) {
  const Vec2 middle = row.line.at(0.5 * (row.t0 + row.t1));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const LineCandidate& line = lines[k];
    const double t = line.line.along(middle);
    if (angle_between(line.line.theta, row.line.theta) < kSameLine_rad &&
        std::abs(line.line.distance(middle)) < kSameLine_m && t > line.support.t0 - reach_m &&
        t < line.support.t1 + reach_m) {
      return static_cast<int>(k);
    }
  }
  return -1;
}

void put_on(const Line2& line, WallPiece& piece) {
  const auto [t0, t1] =
      std::minmax({line.along(piece.line.at(piece.t0)), line.along(piece.line.at(piece.t1))});
  piece.t0 = t0;
  piece.t1 = t1;
  piece.line = line;
}

}  // namespace

std::vector<WallPiece> pieces_of_lines(const WallCells& cells, const CellIndices& free,
                                       const std::vector<LineCandidate>& lines, const PieceRules& rules) {
  std::vector<WallPiece> all;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::map<std::int32_t, CellIndices> by_slice;
    for (const std::uint32_t i : lines[k].support.cells) by_slice[cells.slice[i]].push_back(i);
    const Support& support = lines[k].support;
    for (const std::uint32_t i : free) {
      const double t = lines[k].line.along(position(cells, i));
      const auto slice = by_slice.find(cells.slice[i]);
      if (slice != by_slice.end() && std::abs(lines[k].line.distance(position(cells, i))) < rules.inlier_m &&
          t > support.t0 - rules.tau_m && t < support.t1 + rules.tau_m &&
          (cells.boundary[i] == 0 || angle_between(cells.theta[i], lines[k].line.theta) < kOther_rad)) {
        slice->second.push_back(i);
      }
    }
    for (const auto& [slice, some] : by_slice) {
      for (WallPiece& piece : without_gaps(cells, some, lines[k].line, 3.5 * rules.tau_m)) {
        if (covered_m(cells, piece.cells) < 0.5 * (piece.t1 - piece.t0) || piece.t1 - piece.t0 < kShortest_m)
          continue;
        piece.of = static_cast<int>(k);
        all.push_back(std::move(piece));
      }
    }
  }
  return all;
}

std::vector<WallPiece> short_pieces(const WallCells& cells, const CellIndices& free,
                                    const std::vector<LineCandidate>& lines, const PieceRules& rules) {
  std::vector<WallPiece> pieces;
  const RowSearch search(cells, rules);
  for (const CellIndices& group :
       group_cells(cells, unexplained(cells, free, lines, rules), rules.tau_m, kTogether)) {
    if (covered_m(cells, group) < kCovered * kShortest_m) continue;
    const std::optional<double> theta = direction_beside(cells, group, lines);
    if (theta) search.find(group, *theta, pieces);
  }
  for (WallPiece& piece : pieces) {
    piece.of = line_under(piece, lines, kReach_m);
    const int in_row = line_under(piece, lines, kRow_m);
    if (in_row >= 0) put_on(lines[static_cast<std::size_t>(in_row)].line, piece);
  }
  return pieces;
}

}  // namespace roomcut::detect_lines

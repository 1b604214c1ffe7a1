// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/jogs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/detect_lines/upward.h"

namespace roomcut::detect_lines {
namespace {

constexpr double kParallel_rad = 0.035;
constexpr double kAcross_rad = 0.1;
constexpr double kShallowest_m = 0.05, kDeepest_m = 0.6;
constexpr double kBeyond_m = 0.1;      // how far both pieces go on, each to its side
constexpr double kCorner_m = 0.08;     // a line across so near an end closes it
constexpr double kSeen = 0.4;          // share of a reveal
constexpr double kCorners_m = 0.05;    // of its depth that lies in cells of both walls
constexpr double kSamePlace_m = 0.15;  // reveals nearer than this are one, seen in several slices
constexpr double kHigh = 0.7;      // share of a slice's evidence that a short piece covers: up to the ceiling
constexpr double kBehind_m = 0.6;  // along what stands before a wall: where the wall is looked for behind it
constexpr double kGoesOn = 0.4;    // share of that on which the wall is seen

Vec2 position(const WallCells& cells, std::uint32_t i) {
  return {cells.x[i], cells.y[i]};
}

/// Where one of two parallel pieces ends and the other one begins.
struct Jog {
  std::size_t from = 0, to = 0;
  double t = 0;        ///< along from's line
  double depth_m = 0;  ///< from from's line to that of `to`, signed
};

/// Interval of a piece along another line.
std::pair<double, double> along(const Line2& line, const WallPiece& piece) {
  return std::minmax({line.along(piece.line.at(piece.t0)), line.along(piece.line.at(piece.t1))});
}

class JogSearch {
 public:
  JogSearch(const WallCells& cells, const CellIndices& free, const std::vector<LineCandidate>& lines,
            const PieceRules& rules)
      : cells_(cells),
        free_(free),
        lines_(lines),
        rules_(rules),
        upward_(cells, rules.tau_m),
        ends_m_(std::max(0.1, 3.5 * rules.tau_m)) {
    pieces_ = pieces_of_lines(cells, free, lines, rules);
    short_from_ = pieces_.size();
    for (WallPiece& piece : short_pieces(cells, free, lines, rules)) pieces_.push_back(std::move(piece));
    alive_.assign(pieces_.size(), true);
  }

  std::vector<Side> run() {
    find_jogs();
    drop_open_pieces();
    std::vector<Side> sides;
    for (std::size_t k = short_from_; k < pieces_.size(); ++k) {
      if (alive_[k] && pieces_[k].of < 0) sides.push_back(side_of(pieces_[k]));
    }
    for (const Jog& jog : jogs_) {
      if (alive_[jog.from] && alive_[jog.to] && !closed_by_line(jog)) add_reveal(jog, sides);
    }
    return sides;
  }

 private:
  void find_jogs() {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (std::size_t j = i + 1; j < pieces_.size(); ++j) {
        if (pieces_[i].slice != pieces_[j].slice ||
            angle_between(pieces_[i].line.theta, pieces_[j].line.theta) > kParallel_rad) {
          continue;
        }
        const auto [t0, t1] = along(pieces_[i].line, pieces_[j]);
        if (is_jog(pieces_[i].t0, pieces_[i].t1, t0, t1)) add_jog(i, j, 0.5 * (pieces_[i].t1 + t0));
        if (is_jog(t0, t1, pieces_[i].t0, pieces_[i].t1)) add_jog(i, j, 0.5 * (pieces_[i].t0 + t1));
      }
    }
  }

  /// Whether the first interval ends where the second one begins.
  bool is_jog(double first0, double first1, double second0, double second1) const {
    return std::abs(second0 - first1) <= ends_m_ && second1 > first1 + kBeyond_m &&
           first0 < second0 - kBeyond_m;
  }

  void add_jog(std::size_t i, std::size_t j, double t) {
    const Vec2 place = pieces_[i].line.at(t);
    const double depth = pieces_[i].line.distance(pieces_[j].line.at(pieces_[j].line.along(place)));
    if (std::abs(depth) < kShallowest_m || std::abs(depth) > kDeepest_m) return;
    if (!goes_on_behind(i, j, place) && !goes_on_behind(j, i, place)) jogs_.push_back({i, j, t, depth});
  }

  /// Whether the line of one piece is seen beside the other one, too: furniture stands before a wall.
  bool goes_on_behind(std::size_t wall, std::size_t before, const Vec2& place) const {
    const WallPiece& of = pieces_[wall];
    if (of.of < 0) return false;
    const auto [t0, t1] = along(of.line, pieces_[before]);
    const double t = of.line.along(place);
    const bool up = t1 - t > t - t0;
    const double length = std::min(kBehind_m, (up ? t1 - t : t - t0) - 2 * ends_m_);
    if (length < rules_.tau_m) return false;
    const double from = up ? t + ends_m_ : t - ends_m_ - length;
    return seen_m(of, from, from + length) > kGoesOn * length;
  }

  /// Length of the interval along a piece's line on which that line was seen in its slice.
  double seen_m(const WallPiece& of, double from, double to) const {
    double sum = 0;
    for (const WallPiece& piece : pieces_) {
      if (piece.of != of.of || piece.slice != of.slice) continue;
      const auto [t0, t1] = along(of.line, piece);
      sum += std::max(0.0, std::min(t1, to) - std::max(t0, from));
    }
    return sum;
  }

  /// A short piece stays when it goes up to the ceiling and something closes both of its ends.
  void drop_open_pieces() {
    for (std::size_t k = short_from_; k < pieces_.size(); ++k) {
      const WallPiece& piece = pieces_[k];
      alive_[k] = coverage(piece.cells) >= kHigh &&
                  upward_.reaches_ceiling(piece.line, piece.t0, piece.t1, piece.slice);
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t k = short_from_; k < pieces_.size(); ++k) {
        if (alive_[k] && !(is_closed(k, false) && is_closed(k, true))) {
          alive_[k] = false;
          changed = true;
        }
      }
    }
  }

  bool is_closed(std::size_t k, bool far_end) const {
    const WallPiece& piece = pieces_[k];
    const Vec2 end = piece.line.at(far_end ? piece.t1 : piece.t0);
    const bool by_jog = std::any_of(jogs_.begin(), jogs_.end(), [&](const Jog& jog) {
      if (!alive_[jog.from] || !alive_[jog.to]) return false;
      if (jog.from != k && jog.to != k) return false;
      const Vec2 place = pieces_[jog.from].line.at(jog.t);
      return std::abs(piece.line.along(place) - piece.line.along(end)) <= ends_m_;
    });
    return by_jog || line_across(piece.line.theta, end);
  }

  bool line_across(double theta, const Vec2& place) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const LineCandidate& line) {
      const double t = line.line.along(place);
      return angle_between(line.line.theta, theta + std::numbers::pi / 2) < kAcross_rad &&
             std::abs(line.line.distance(place)) < kCorner_m + rules_.tau_m &&
             t > line.support.t0 - kBeyond_m && t < line.support.t1 + kBeyond_m;
    });
  }

  bool closed_by_line(const Jog& jog) const {
    const WallPiece& from = pieces_[jog.from];
    return line_across(from.line.theta, from.line.at(jog.t) + 0.5 * jog.depth_m * from.line.normal());
  }

  static Side side_of(const WallPiece& piece) {
    return {piece.line, {piece.t0, piece.t1, piece.t1 - piece.t0, piece.cells}, {}};
  }

  /// The reveal of a jog, or what this slice says of one that another slice gave.
  void add_reveal(const Jog& jog, std::vector<Side>& sides) const {
    const WallPiece& from = pieces_[jog.from];
    const auto [low, high] = std::minmax({0.0, jog.depth_m});
    const double margin = std::min(0.5 * rules_.inlier_m, 0.2 * std::abs(jog.depth_m));
    CellIndices between;
    for (const std::uint32_t i : free_) {
      if (cells_.slice[i] != from.slice) continue;
      const Vec2 p = position(cells_, i);
      const double off = from.line.distance(p);
      const double t = from.line.along(p);
      if (off < low + margin || off > high - margin || std::abs(t - jog.t) > ends_m_) continue;
      between.push_back(i);
    }
    const double t = middle_of(between, from.line, jog.t);
    if (covered_m(between) < kSeen * (std::abs(jog.depth_m) - kCorners_m)) return;
    const double theta = from.line.theta + std::numbers::pi / 2;
    const Vec2 a = from.line.at(t);
    const Vec2 b = a + jog.depth_m * from.line.normal();
    const Line2 line = normalised(theta, Line2{theta, 0}.normal().dot(a));
    const auto [t0, t1] = std::minmax({line.along(a), line.along(b)});
    const Vec2 middle = 0.5 * (a + b);
    if (!upward_.reaches_ceiling(line, t0, t1, from.slice)) return;
    const Side reveal{line, {t0, t1, t1 - t0, between}, {}};
    const auto known = std::find_if(sides.begin(), sides.end(), [&](const Side& side) {
      return angle_between(side.line.theta, line.theta) < kAcross_rad &&
             std::abs(side.line.distance(middle)) < kSamePlace_m &&
             side.line.along(middle) > side.support.t0 && side.line.along(middle) < side.support.t1;
    });
    if (known == sides.end()) {
      sides.push_back(reveal);
    } else if (covered_m(between) > covered_m(known->support.cells)) {
      *known = reveal;
    }
  }

  /// Mean share of the height of their slice's evidence over which cells were seen.
  double coverage(const CellIndices& some) const {
    double sum = 0;
    for (const std::uint32_t i : some) sum += cells_.coverage[i];
    return some.empty() ? 0 : sum / static_cast<double>(some.size());
  }

  double covered_m(const CellIndices& some) const {
    double sum = 0;
    for (const std::uint32_t i : some) sum += cells_.weight_m[i];
    return sum;
  }

  /// Mean place along a line of the cells near their median; `otherwise` where there are none.
  double middle_of(CellIndices& some, const Line2& line, double otherwise) const {
    if (some.empty()) return otherwise;
    const auto t_of = [&](std::uint32_t i) { return line.along(position(cells_, i)); };
    std::vector<double> sorted;
    for (const std::uint32_t i : some) sorted.push_back(t_of(i));
    std::sort(sorted.begin(), sorted.end());
    const double median = sorted[sorted.size() / 2];
    std::erase_if(some, [&](std::uint32_t i) { return std::abs(t_of(i) - median) > 0.75 * rules_.tau_m; });
    double sum = 0, weight = 0;
    for (const std::uint32_t i : some) {
      sum += cells_.area_m2[i] * t_of(i);
      weight += cells_.area_m2[i];
    }
    return sum / weight;
  }

  const WallCells& cells_;
  const CellIndices& free_;
  const std::vector<LineCandidate>& lines_;
  PieceRules rules_;
  Upward upward_;
  double ends_m_;                  ///< ends so near each other belong together
  std::vector<WallPiece> pieces_;  ///< of lines, then short ones
  std::size_t short_from_ = 0;
  std::vector<bool> alive_;
  std::vector<Jog> jogs_;
};

}  // namespace

std::vector<Side> short_sides(const WallCells& cells, const CellIndices& free,
                              const std::vector<LineCandidate>& lines, const PieceRules& rules) {
  return JogSearch(cells, free, lines, rules).run();
}

}  // namespace roomcut::detect_lines

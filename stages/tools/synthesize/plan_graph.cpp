// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/plan_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/errors/codes.h"

namespace roomcut::synthesize {

namespace {

constexpr int kRounds = 64;  // of cutting; two or three are enough for plans

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

class Cutter {
 public:
  Cutter(const std::vector<Polygon2>& polygons, double tolerance) : tolerance_(tolerance) {
    for (const Polygon2& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        add(vertex(polygon[i]), vertex(polygon[(i + 1) % polygon.size()]), segments_);
      }
    }
  }

  PlanGraph cut() {
    for (int round = 0; round < kRounds; ++round) {
      sort_segments();
      if (!cut_once()) return {vertices_, segments_};
    }
    too_tangled();
  }

 private:
  using Segment = std::array<std::int32_t, 2>;
  static constexpr std::size_t kMostVertices = 200000;  // twice the corners of the largest scene

  [[noreturn]] static void too_tangled() {
    throw StageError(errors::kSceneInvalid, "the plans of the rooms",
                     "they cross each other too often, or too close together, to be cut into pieces",
                     "rooms may not overlap: leave a wall between them");
  }

  /// The corner at p: a known one within the tolerance, or a new one.
  std::int32_t vertex(const Vec2& p) {
    const auto x = static_cast<std::int64_t>(std::floor(p.x() / tolerance_));
    const auto y = static_cast<std::int64_t>(std::floor(p.y() / tolerance_));
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto found = grid_.find({x + dx, y + dy});
        if (found != grid_.end() &&
            (vertices_[static_cast<std::size_t>(found->second)] - p).norm() <= tolerance_) {
          return found->second;
        }
      }
    }
    if (vertices_.size() >= kMostVertices) too_tangled();
    const auto index = static_cast<std::int32_t>(vertices_.size());
    vertices_.push_back(p);
    grid_.emplace(std::pair{x, y}, index);
    return index;
  }

  static void add(std::int32_t a, std::int32_t b, std::vector<Segment>& segments) {
    if (a != b) segments.push_back({std::min(a, b), std::max(a, b)});
  }

  void sort_segments() {
    std::sort(segments_.begin(), segments_.end());
    segments_.erase(std::unique(segments_.begin(), segments_.end()), segments_.end());
  }

  double low(const Segment& s, int axis) const {
    return std::min(at(s[0])[axis], at(s[1])[axis]) - tolerance_;
  }
  double high(const Segment& s, int axis) const {
    return std::max(at(s[0])[axis], at(s[1])[axis]) + tolerance_;
  }
  const Vec2& at(std::int32_t v) const { return vertices_[static_cast<std::size_t>(v)]; }

  /// One round over all pairs with overlapping boxes; returns whether anything was cut.
  bool cut_once() {
    std::vector<std::size_t> by_x(segments_.size());
    for (std::size_t i = 0; i < by_x.size(); ++i) by_x[i] = i;
    std::stable_sort(by_x.begin(), by_x.end(), [&](std::size_t a, std::size_t b) {
      return low(segments_[a], 0) < low(segments_[b], 0);
    });
    cuts_.assign(segments_.size(), {});
    for (std::size_t i = 0; i < by_x.size(); ++i) {
      const Segment& a = segments_[by_x[i]];
      for (std::size_t j = i + 1; j < by_x.size() && low(segments_[by_x[j]], 0) <= high(a, 0); ++j) {
        const Segment& b = segments_[by_x[j]];
        if (low(b, 1) <= high(a, 1) && low(a, 1) <= high(b, 1)) cut_pair(by_x[i], by_x[j]);
      }
    }
    return apply_cuts();
  }

  void cut_pair(std::size_t i, std::size_t j) {
    const Segment a = segments_[i];
    const Segment b = segments_[j];
    bool touches = false;
    for (const std::int32_t v : b) touches |= cut_if_on(i, v);
    for (const std::int32_t v : a) touches |= cut_if_on(j, v);
    if (touches || a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) return;
    const Vec2 u = at(a[1]) - at(a[0]);
    const Vec2 v = at(b[1]) - at(b[0]);
    const Vec2 w = at(b[0]) - at(a[0]);
    const double det = cross(u, v);
    if (det == 0) return;
    const double s = cross(w, v) / det;
    const double t = cross(w, u) / det;
    if (s <= 0 || s >= 1 || t <= 0 || t >= 1) return;
    const std::int32_t crossing = vertex(at(a[0]) + s * u);
    cuts_[i].push_back(crossing);
    cuts_[j].push_back(crossing);
  }

  /// Cuts segment i at corner v when v lies on it, apart from its ends.
  bool cut_if_on(std::size_t i, std::int32_t v) {
    const Segment& s = segments_[i];
    if (v == s[0] || v == s[1]) return false;
    const Vec2 u = at(s[1]) - at(s[0]);
    const Vec2 w = at(v) - at(s[0]);
    const double share = w.dot(u) / u.squaredNorm();
    if (share <= 0 || share >= 1 || std::abs(cross(u, w)) > tolerance_ * u.norm()) return false;
    cuts_[i].push_back(v);
    return true;
  }

  bool apply_cuts() {
    std::vector<Segment> pieces;
    bool any = false;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      std::vector<std::int32_t> chain = cuts_[i];
      const Vec2 from = at(segments_[i][0]);
      const Vec2 along = at(segments_[i][1]) - from;
      std::sort(chain.begin(), chain.end(), [&](std::int32_t a, std::int32_t b) {
        return std::pair((at(a) - from).dot(along), a) < std::pair((at(b) - from).dot(along), b);
      });
      std::int32_t before = segments_[i][0];
      for (const std::int32_t v : chain) {
        any |= v != segments_[i][0] && v != segments_[i][1];
        add(before, v, pieces);
        before = v;
      }
      add(before, segments_[i][1], pieces);
    }
    segments_ = std::move(pieces);
    return any;
  }

  double tolerance_;
  std::vector<Vec2> vertices_;
  std::vector<Segment> segments_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int32_t> grid_;
  std::vector<std::vector<std::int32_t>> cuts_;
};

}  // namespace

PlanGraph cut_at_crossings(const std::vector<Polygon2>& polygons, double tolerance) {
  return Cutter(polygons, tolerance).cut();
}

}  // namespace roomcut::synthesize

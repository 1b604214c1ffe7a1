// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/plan/segment_inserter.h"

#include <algorithm>
#include <cmath>

#include "common/cells/cell_complex.h"

namespace roomcut {

namespace {

/// The faces along the segment are gathered with more tolerance than they are split with, so that neither the
/// point location nor a vertex that two faces see differently can tear the walk.
constexpr double kReach_m = 4 * kPlanSnap_m;

int side_of(double distance) {
  return distance > kPlanSnap_m ? 1 : distance < -kPlanSnap_m ? -1 : 0;
}

}  // namespace

int SegmentInserter::insert(const PlanSegment& segment, std::int32_t index, std::int32_t within) {
  segment_ = segment;
  normal_ = segment.line.normal();
  direction_ = segment.line.direction();
  double t0 = segment.t0;
  double t1 = segment.t1;
  if (!clip_to_rectangle(t0, t1)) {
    return 0;
  }
  collect_faces(plan_.locate(segment.line.at(0.5 * (t0 + t1)), within));
  int splits = 0;
  for (const std::int32_t face : faces_) {
    note_shared_edges(face, index);
    ChordEnd down;
    ChordEnd up;
    if (!find_chord(face, down, up) || !worth_a_split(down, up)) {
      continue;
    }
    const std::int32_t h = down.inside ? plan_.split_edge(down.h, down.point) : down.h;
    const std::int32_t g = up.inside ? plan_.split_edge(up.h, up.point) : up.h;
    plan_.split_face(h, g, index, segment_.line);
    ++splits;
  }
  return splits;
}

/// Narrows [t0, t1] to the part inside the rectangle; false when there is none.
bool SegmentInserter::clip_to_rectangle(double& t0, double& t1) const {
  const Vec2& low = plan_.low();
  const Vec2& high = plan_.high();
  const Vec2 foot = segment_.line.d * normal_;
  for (int axis = 0; axis < 2; ++axis) {
    const double slope = direction_[axis];
    if (std::abs(slope) < 1e-15) {
      if (foot[axis] < low[axis] || foot[axis] > high[axis]) {
        return false;
      }
      continue;
    }
    const double a = (low[axis] - foot[axis]) / slope;
    const double b = (high[axis] - foot[axis]) / slope;
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 < t1;
}

/// Fills faces_ with the faces that the segment enters or touches: from face to face across the edges it
/// meets.
void SegmentInserter::collect_faces(std::int32_t start) {
  seen_.resize(plan_.face_start.size(), 0);
  ++round_;
  faces_.assign(1, start);
  seen_[start] = round_;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const std::int32_t first = plan_.face_start[faces_[i]];
    std::int32_t h = first;
    do {
      const std::int32_t beyond = plan_.half_edges[plan_.twin(h)].face;
      if (beyond != Subdivision::kOutside && seen_[beyond] != round_ && touches_segment(h)) {
        seen_[beyond] = round_;
        faces_.push_back(beyond);
      }
      h = plan_.half_edges[h].next;
    } while (h != first);
  }
}

bool SegmentInserter::touches_segment(std::int32_t h) const {
  const std::int32_t end = plan_.half_edges[h].next;
  const double da = distance(h);
  const double db = distance(end);
  if (std::min(da, db) > kReach_m || std::max(da, db) < -kReach_m) {
    return false;
  }
  double s0 = 0;
  double s1 = 1;
  if (std::abs(db - da) > kReach_m) {  // the part of the edge within reach of the line
    s0 = std::clamp((-std::copysign(kReach_m, db - da) - da) / (db - da), 0.0, 1.0);
    s1 = std::clamp((std::copysign(kReach_m, db - da) - da) / (db - da), 0.0, 1.0);
  }
  const double ta = along(h);
  const double step = along(end) - ta;
  const auto [low, high] = std::minmax({ta + s0 * step, ta + s1 * step});
  return low <= segment_.t1 + kReach_m && high >= segment_.t0 - kReach_m;
}

/// Notes the face's edges that the segment runs along. They stay with the line that was there first, for now.
void SegmentInserter::note_shared_edges(std::int32_t face, std::int32_t index) {
  const std::int32_t first = plan_.face_start[face];
  std::int32_t h = first;
  do {
    const std::int32_t owner = plan_.half_edges[h].line;
    if (owner != Subdivision::kNoLine && owner != index && runs_along(plan_, h, segment_.line) &&
        overlap(plan_, h, segment_) > kPlanSnap_m) {
      shared_.emplace(owner, index);
    }
    h = plan_.half_edges[h].next;
  } while (h != first);
}

/// The ends of the chord that the line cuts from the face: `down` where the boundary, counter-clockwise,
/// passes from the line's positive to its negative side, `up` where it comes back. False when the face lies
/// on one side.
bool SegmentInserter::find_chord(std::int32_t face, ChordEnd& down, ChordEnd& up) const {
  const std::int32_t first = plan_.face_start[face];
  std::int32_t top = first;
  double highest = distance(first);
  double lowest = highest;
  for (std::int32_t h = plan_.half_edges[first].next; h != first; h = plan_.half_edges[h].next) {
    const double d = distance(h);
    lowest = std::min(lowest, d);
    if (d > highest) {
      highest = d;
      top = h;
    }
  }
  if (side_of(highest) <= 0 || side_of(lowest) >= 0) {
    return false;
  }
  int side = 1;
  int passages = 0;
  ChordEnd on_line;  // the corner nearest to the line since the last one beside it
  std::int32_t h = top;
  do {
    h = plan_.half_edges[h].next;
    const double d = distance(h);
    if (side_of(d) == 0) {
      if (on_line.h < 0 || std::abs(d) < on_line.off) {
        on_line = {h, false, plan_.from(h), std::abs(d)};
      }
      continue;
    }
    if (side_of(d) != side) {
      (side > 0 ? down : up) = end_before(h, on_line);
      side = -side;
      ++passages;
    }
    on_line = ChordEnd{};
  } while (h != top);
  return passages == 2;  // always, as long as the face is convex
}

/// The chord's end on the boundary before h: the corner on the line if there is one, else a new vertex in the
/// edge.
SegmentInserter::ChordEnd SegmentInserter::end_before(std::int32_t h, ChordEnd on_line) const {
  if (on_line.h >= 0) {
    return on_line;
  }
  const std::int32_t edge = plan_.half_edges[h].prev;
  const double da = distance(edge);
  const double db = distance(h);
  const double s = da / (da - db);
  return {edge, true, plan_.from(edge) + s * (plan_.from(h) - plan_.from(edge)), 0.0};
}

/// Whether the chord meets the segment and leaves two parts of more than snapping width.
bool SegmentInserter::worth_a_split(const ChordEnd& down, const ChordEnd& up) const {
  const auto [low, high] = std::minmax({direction_.dot(down.point), direction_.dot(up.point)});
  if (high <= segment_.t0 + kPlanSnap_m || low >= segment_.t1 - kPlanSnap_m) {
    return false;
  }
  const Vec2 chord = up.point - down.point;
  const double length = chord.norm();
  if (length < kPlanSnap_m) {
    return false;
  }
  double left = 0;
  double right = 0;
  std::int32_t h = down.h;
  do {
    const Vec2 arm = plan_.from(h) - down.point;
    const double off = (chord.x() * arm.y() - chord.y() * arm.x()) / length;
    left = std::max(left, off);
    right = std::min(right, off);
    h = plan_.half_edges[h].next;
  } while (h != down.h);
  return left > 0.5 * kPlanSnap_m && right < -0.5 * kPlanSnap_m;
}

}  // namespace roomcut

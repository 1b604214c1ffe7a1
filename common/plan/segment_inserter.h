// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "common/plan/plan_segment.h"

namespace roomcut {

/// Cuts segments into a subdivision. Keeps scratch memory between lines.
class SegmentInserter {
 public:
  explicit SegmentInserter(Subdivision& subdivision) : plan_(subdivision) {}

  /// Splits every face that the segment enters, each along its whole chord; the new edges lie on line
  /// `index`. A vertex within kPlanSnap_m of the line counts as lying on it; a face is left alone when one of
  /// its parts would be thinner, or the chord shorter, than that: there the face's own side stands for the
  /// line. Only the faces along the segment are looked at, beginning with the one at its middle, which must
  /// lie in the original face `within`. Returns the number of faces split.
  int insert(const PlanSegment& segment, std::int32_t index, std::int32_t within = 0);

  /// Pairs (line of an edge, line inserted later whose segment runs along that edge): lines that share edges,
  /// ascending.
  const std::set<std::pair<std::int32_t, std::int32_t>>& shared() const { return shared_; }

 private:
  struct ChordEnd {
    std::int32_t h = -1;  ///< the end is origin(h), or a new vertex at `point` inside h
    bool inside = false;
    Vec2 point{0, 0};
    double off = 0;  ///< distance of the end from the line [m]
  };

  bool clip_to_rectangle(double& t0, double& t1) const;
  void collect_faces(std::int32_t start);
  bool touches_segment(std::int32_t h) const;
  void note_shared_edges(std::int32_t face, std::int32_t index);
  bool find_chord(std::int32_t face, ChordEnd& down, ChordEnd& up) const;
  ChordEnd end_before(std::int32_t h, ChordEnd on_line) const;
  bool worth_a_split(const ChordEnd& down, const ChordEnd& up) const;
  double distance(std::int32_t h) const { return normal_.dot(plan_.from(h)) - segment_.line.d; }
  double along(std::int32_t h) const { return direction_.dot(plan_.from(h)); }

  Subdivision& plan_;
  PlanSegment segment_{};
  Vec2 normal_{1, 0}, direction_{0, 1};
  std::vector<std::int32_t> faces_;  ///< along the segment
  std::vector<std::int32_t> seen_;   ///< face -> round_ when it is in faces_
  std::int32_t round_ = 0;
  std::set<std::pair<std::int32_t, std::int32_t>> shared_;
};

}  // namespace roomcut

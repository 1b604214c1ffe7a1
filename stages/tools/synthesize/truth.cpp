// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/truth.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <unordered_map>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/plan_union.h"
#include "stages/tools/synthesize/scene_limits.h"

namespace roomcut::synthesize {

namespace {

/// Turns the plan and its layers into the border surface. A corner (vertex v, height l) exists where a
/// horizontal face begins or ends at l beside v; walls run unbroken past all other heights.
class Extruder {
 public:
  explicit Extruder(const PlanUnion& plan) : plan_(plan), levels_(plan.heights.size()) {
    corner_.assign(plan.vertices.size() * levels_, kNone);
  }

  TriangleMesh extrude() {
    add_corners();
    for (std::size_t t = 0; t < plan_.triangles.size(); ++t) add_horizontal(t);
    for (const PlanUnion::Edge& edge : plan_.edges) add_walls(edge);
    return mesh_;
  }

 private:
  static constexpr std::int32_t kNone = -1;
  using Layer = std::ptrdiff_t;

  std::int32_t& corner(std::int32_t vertex, std::size_t level) { return corner_[vertex * levels_ + level]; }
  bool changes(std::int32_t region, std::size_t level) const {
    const Layer layer = static_cast<Layer>(level);
    return plan_.is_empty(region, layer - 1) != plan_.is_empty(region, layer);
  }

  void add_corners() {
    for (std::size_t t = 0; t < plan_.triangles.size(); ++t) {
      for (std::size_t l = 0; l < levels_; ++l) {
        if (!changes(plan_.triangle_region[t], l)) continue;
        for (const std::int32_t v : plan_.triangles[t]) corner(v, l) = 0;
      }
    }
    for (std::size_t v = 0; v < plan_.vertices.size(); ++v) {
      for (std::size_t l = 0; l < levels_; ++l) {
        std::int32_t& c = corner(static_cast<std::int32_t>(v), l);
        if (c == kNone) continue;
        c = static_cast<std::int32_t>(mesh_.vertices.size());
        mesh_.vertices.emplace_back(plan_.vertices[v].x(), plan_.vertices[v].y(), plan_.heights[l]);
      }
    }
  }

  void add_horizontal(std::size_t t) {
    const Triangle& plan = plan_.triangles[t];
    for (std::size_t l = 0; l < levels_; ++l) {
      if (!changes(plan_.triangle_region[t], l)) continue;
      Triangle face{corner(plan[0], l), corner(plan[1], l), corner(plan[2], l)};  // a ceiling: normal up
      if (plan_.is_empty(plan_.triangle_region[t], static_cast<Layer>(l))) std::swap(face[1], face[2]);
      mesh_.triangles.push_back(face);
    }
  }

  void add_walls(const PlanUnion::Edge& edge) {
    const Layer layers = static_cast<Layer>(levels_) - 1;
    for (Layer k = 0; k < layers;) {
      const bool left = plan_.is_empty(edge.left, k);
      const bool right = plan_.is_empty(edge.right, k);
      Layer end = k + 1;
      while (end < layers && plan_.is_empty(edge.left, end) == left &&
             plan_.is_empty(edge.right, end) == right)
        ++end;
      if (left && !right) add_strip(edge.v0, edge.v1, k, end);
      if (right && !left) add_strip(edge.v1, edge.v0, k, end);
      k = end;
    }
  }

  /// The wall over v0 -> v1 between two levels, its normal to the right: two chains of corners, zipped.
  void add_strip(std::int32_t v0, std::int32_t v1, Layer from, Layer to) {
    const std::vector<std::int32_t> left = chain(v0, from, to);
    const std::vector<std::int32_t> right = chain(v1, from, to);
    std::size_t i = 0;
    std::size_t j = 0;
    while (i + 1 < left.size() || j + 1 < right.size()) {
      const bool left_next =
          j + 1 == right.size() ||
          (i + 1 < left.size() && mesh_.vertices[left[i + 1]].z() < mesh_.vertices[right[j + 1]].z());
      if (left_next) {
        mesh_.triangles.push_back({left[i], right[j], left[i + 1]});
        ++i;
      } else {
        mesh_.triangles.push_back({left[i], right[j], right[j + 1]});
        ++j;
      }
    }
  }

  std::vector<std::int32_t> chain(std::int32_t v, Layer from, Layer to) {
    std::vector<std::int32_t> corners;
    for (Layer l = from; l <= to; ++l) {
      if (corner(v, static_cast<std::size_t>(l)) != kNone)
        corners.push_back(corner(v, static_cast<std::size_t>(l)));
    }
    return corners;
  }

  const PlanUnion& plan_;
  std::size_t levels_;
  std::vector<std::int32_t> corner_;
  TriangleMesh mesh_;
};

std::string at(const Vec3& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ", " << p.z() << ")";
  return text.str();
}

}  // namespace

TriangleMesh make_truth(const Scene& scene, const Building& building) {
  std::vector<Problem> problems;
  const PlanUnion plan = unite(scene, building, problems);
  if (!problems.empty()) refuse_scene(problems);
  TriangleMesh mesh = Extruder(plan).extrude();
  const std::string defect = find_defect(mesh);
  if (!defect.empty()) {
    throw StageError(errors::kSceneInvalid, scene.name, "the empty space is not 2-manifold: " + defect,
                     "rooms or passages meet in an edge or a corner there: move one of them");
  }
  return mesh;
}

std::string find_defect(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, std::int32_t> third;  // directed edge -> third corner of its triangle
  const auto key = [](std::int32_t a, std::int32_t b) {
    return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
  };
  std::vector<std::size_t> corners(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      ++corners[t[i]];
      if (!third.emplace(key(t[i], t[(i + 1) % 3]), t[(i + 2) % 3]).second) {
        return "an edge with more than two faces at " + at(mesh.vertices[t[i]]);
      }
    }
  }
  std::vector<char> seen(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::int32_t v = t[i];
      if (seen[v] != 0) continue;
      seen[v] = 1;
      std::size_t fan = 0;
      std::int32_t next = t[(i + 1) % 3];
      do {  // once around v
        const auto found = third.find(key(v, next));
        if (found == third.end()) return "an open edge at " + at(mesh.vertices[v]);
        next = found->second;
        ++fan;
      } while (next != t[(i + 1) % 3] && fan <= corners[v]);
      if (fan != corners[v]) return "two sheets touch at " + at(mesh.vertices[v]);
    }
  }
  return "";
}

}  // namespace roomcut::synthesize

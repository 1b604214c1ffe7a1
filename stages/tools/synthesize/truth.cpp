// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/truth.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/plan_union.h"
#include "stages/tools/synthesize/scene_limits.h"

namespace roomcut::synthesize {

namespace {

/// Turns the plan and its layers into the border surface. A corner (vertex v, surface s) exists where a
/// floor or ceiling begins or ends on s beside v; walls run unbroken past all other surfaces.
class Extruder {
 public:
  explicit Extruder(const PlanUnion& plan)
      : plan_(plan), levels_(plan.heights.size()), corners_(plan.vertices.size()) {}

  TriangleMesh extrude() {
    add_corners();
    for (std::size_t t = 0; t < plan_.triangles.size(); ++t) add_horizontal(t);
    for (const PlanUnion::Edge& edge : plan_.edges) add_walls(edge);
    return mesh_;
  }

 private:
  /// Where a surface has a corner over a vertex of the plan.
  struct Corner {
    std::int32_t surface;
    double z;
    std::int32_t number;  ///< of the mesh's vertex
  };

  std::int32_t corner(std::int32_t vertex, std::int32_t surface) const {
    const std::vector<Corner>& there = corners_[static_cast<std::size_t>(vertex)];
    return std::find_if(there.begin(), there.end(), [&](const Corner& c) { return c.surface == surface; })
        ->number;
  }
  double z(std::int32_t corner) const { return mesh_.vertices[static_cast<std::size_t>(corner)].z(); }

  void add_corners() {
    for (std::size_t t = 0; t < plan_.triangles.size(); ++t) {
      const std::int32_t region = plan_.triangle_region[t];
      for (std::size_t l = 0; l < levels_; ++l) {
        if (!plan_.changes(region, l)) continue;
        for (const std::int32_t v : plan_.triangles[t]) add_corner(v, plan_.surface[region][l]);
      }
    }
    for (std::size_t v = 0; v < corners_.size(); ++v) number_corners(plan_.vertices[v], corners_[v]);
  }

  void add_corner(std::int32_t vertex, std::int32_t surface) {
    std::vector<Corner>& there = corners_[static_cast<std::size_t>(vertex)];
    const bool known =
        std::any_of(there.begin(), there.end(), [&](const Corner& c) { return c.surface == surface; });
    if (!known)
      there.push_back({surface, plan_.height(surface, plan_.vertices[static_cast<std::size_t>(vertex)]), 0});
  }

  /// From below; surfaces that meet there have one corner, at a level one's height.
  void number_corners(const Vec2& p, std::vector<Corner>& there) {
    std::sort(there.begin(), there.end(), [](const Corner& a, const Corner& b) {
      return std::pair(a.z, a.surface) < std::pair(b.z, b.surface);
    });
    for (std::size_t i = 0; i < there.size(); ++i) {
      const bool level = static_cast<std::size_t>(there[i].surface) < levels_;
      if (i == 0 || there[i].z - there[i - 1].z > PlanUnion::kSame) {
        mesh_.vertices.emplace_back(p.x(), p.y(), there[i].z);
      } else if (level) {
        mesh_.vertices.back().z() = there[i].z;
      }
      there[i].number = static_cast<std::int32_t>(mesh_.vertices.size()) - 1;
    }
  }

  void add_horizontal(std::size_t t) {
    const Triangle& plan = plan_.triangles[t];
    const std::int32_t region = plan_.triangle_region[t];
    for (std::size_t l = 0; l < levels_; ++l) {
      if (!plan_.changes(region, l)) continue;
      const std::int32_t s = plan_.surface[region][l];
      Triangle face{corner(plan[0], s), corner(plan[1], s), corner(plan[2], s)};  // a ceiling: normal up
      if (plan_.is_empty(region, static_cast<std::ptrdiff_t>(l))) std::swap(face[1], face[2]);
      mesh_.triangles.push_back(face);
    }
  }

  /// Where a region's emptiness begins or ends over an edge, from below.
  struct Border {
    double middle;          ///< height over the middle of the edge
    std::int32_t from, to;  ///< corners at its ends
    bool left;              ///< of the region to the left
  };

  std::vector<Border> borders(const PlanUnion::Edge& edge) {
    std::vector<Border> all;
    for (const std::int32_t region : {edge.left, edge.right}) {
      for (std::size_t l = 0; l < levels_; ++l) {
        if (!plan_.changes(region, l)) continue;
        const std::int32_t from = corner(edge.v0, plan_.surface[region][l]);
        const std::int32_t to = corner(edge.v1, plan_.surface[region][l]);
        all.push_back({0.5 * (z(from) + z(to)), from, to, region == edge.left});
      }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Border& a, const Border& b) { return a.middle < b.middle; });
    return all;
  }

  /// Walls stand where just one of the two regions is empty.
  void add_walls(const PlanUnion::Edge& edge) {
    bool left = false;
    bool right = false;
    const Border* last = nullptr;
    const std::vector<Border> all = borders(edge);
    for (const Border& border : all) {
      if (last != nullptr && left && !right) add_strip({last->from, border.from}, {last->to, border.to});
      if (last != nullptr && right && !left) add_strip({last->to, border.to}, {last->from, border.from});
      (border.left ? left : right) = !(border.left ? left : right);
      last = &border;
    }
  }

  /// A wall between two chains of corners, each from below; its normal is to the right of left -> right.
  /// Zipped.
  void add_strip(const std::array<std::int32_t, 2>& left, const std::array<std::int32_t, 2>& right) {
    std::int32_t i = left[0];
    std::int32_t j = right[0];
    while (i < left[1] || j < right[1]) {
      const bool left_next = j == right[1] || (i < left[1] && z(i + 1) < z(j + 1));
      if (left_next) {
        mesh_.triangles.push_back({i, j, i + 1});
        ++i;
      } else {
        mesh_.triangles.push_back({i, j, j + 1});
        ++j;
      }
    }
  }

  const PlanUnion& plan_;
  std::size_t levels_;
  std::vector<std::vector<Corner>> corners_;  // per vertex of the plan
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

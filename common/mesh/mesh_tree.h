// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace roomcut {

/// Bounding-volume tree over (some of) a mesh's triangles, for nearest points and for rays. Keeps what it
/// needs of the mesh. Queries are const and thread-safe; the answers depend on the mesh only.
class MeshTree {
 public:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  explicit MeshTree(const TriangleMesh& mesh);
  /// Only the triangles of `subset` (indices).
  MeshTree(const TriangleMesh& mesh, std::vector<std::int32_t> subset);

  struct Hit {
    double distance = kInfinity;  ///< [m]; infinite when nothing lies within the limit
    std::int32_t triangle = -1;
  };
  /// Nearest triangle within `limit`. `hint`: a triangle likely to be near (e.g. the last answer); -1 for
  /// none.
  Hit nearest(const Vec3& p, double limit = kInfinity, std::int32_t hint = -1) const;
  /// Nearest triangle whose unit normal n has n·direction >= least_cosine.
  Hit nearest_facing(const Vec3& p, double limit, const Vec3& direction, double least_cosine) const;
  /// First triangle that the ray meets, from behind or in front, at a distance of `nearest` to `farthest`
  /// [m]. `unit`: its direction, of length 1.
  Hit first_on_ray(const Vec3& from, const Vec3& unit, double nearest, double farthest) const;

  /// Unit normal of a triangle; zero for one without area.
  const Vec3& unit_normal(std::int32_t triangle) const { return normal_[static_cast<std::size_t>(triangle)]; }
  bool empty() const { return items_.empty(); }

 private:
  struct Node {
    Vec3 lo, hi;
    std::int32_t first, count;  // leaf: items_[first …]; inner (count = 0): children first, first + 1
  };
  struct Item {
    Vec3 a, b, c;
    std::int32_t triangle;
  };
  void build(const TriangleMesh& mesh, std::vector<std::int32_t> subset);
  struct Start {
    double distance2;
    std::int32_t triangle;
  };
  template <class Accept>
  Hit search(const Vec3& p, Start start, const Accept& accept) const;

  std::vector<Node> nodes_;
  std::vector<Item> items_;
  std::vector<std::int32_t> item_of_;  // triangle -> item, -1 = not in the subset
  std::vector<Vec3> normal_;
};

/// Distance from p to the triangle a, b, c, squared [m^2].
double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/cells/cell_complex.h"
#include "tests/unit/cells/three_faces.h"

namespace roomcut {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(FindViolation, AValidComplexHasNone) {
  EXPECT_EQ(find_violation(three_faces()), "");
}

TEST(FindViolation, EveryWayToBreakAComplexIsNamed) {
  struct Case {
    const char* message;
    std::function<void(CellComplex&)> harm;
  };
  const std::vector<Case> cases{
      {"fewer than two levels", [](CellComplex& c) { c.levels.resize(1); }},
      {"level 1: not finite", [](CellComplex& c) { c.levels[1] = kNan; }},
      {"level 2: not above", [](CellComplex& c) { c.levels[2] = 2.5; }},
      {"line 0: not finite", [](CellComplex& c) { c.lines[0].line.d = kNan; }},
      {"line 0: not finite, or its support is turned", [](CellComplex& c) { c.lines[0].t0 = 5; }},
      {"line 1: layers", [](CellComplex& c) { c.lines[1].layers = {2}; }},
      {"line 1: layers",
       [](CellComplex& c) {
         c.lines[1].layers = {1, 0};
       }},
      {"edge 0: vertices", [](CellComplex& c) { c.edges[0].v1 = 8; }},
      {"edge 0: vertices", [](CellComplex& c) { c.edges[0].v1 = 0; }},
      {"edge 1: faces", [](CellComplex& c) { c.edges[1].right = 3; }},
      {"edge 1: faces", [](CellComplex& c) { c.edges[1].right = 0; }},
      {"edge 1: line", [](CellComplex& c) { c.edges[1].line = 2; }},
      {"edge 0: the sides", [](CellComplex& c) { c.edges[0].line = 0; }},
      {"edge 1: the sides", [](CellComplex& c) { c.edges[1].line = -1; }},
      {"edge 1: does not lie", [](CellComplex& c) { c.edges[1].line = 1; }},
      {"edge 1: does not lie", [](CellComplex& c) { c.lines[0].line.d += 2e-5; }},
      {"face offsets", [](CellComplex& c) { c.face_offset[3] = 12; }},
      {"face offsets", [](CellComplex& c) { c.face_edge.pop_back(); }},
      {"face 0: fewer than three", [](CellComplex& c) { c.face_offset[1] = 2; }},
      {"face 0: fewer than three", [](CellComplex& c) { c.face_offset[1] = 20; }},
      {"face 0: corner out of range", [](CellComplex& c) { c.face_vertex[0] = -1; }},
      {"face 0: corner out of range", [](CellComplex& c) { c.face_edge[0] = 10; }},
      {"face 0: an edge does not join", [](CellComplex& c) { c.face_edge[0] = 3; }},
      {"face 0: an edge names another face",
       [](CellComplex& c) { std::swap(c.edges[1].left, c.edges[1].right); }},
      {"vertex 8: belongs to no face", [](CellComplex& c) { c.vertices.emplace_back(1, 1); }},
      {"vertex 0: not finite", [](CellComplex& c) { c.vertices[0].x() = kNan; }},
      {"not convex", [](CellComplex& c) { c.vertices[7].x() -= 5e-8; }},
      {"not convex",
       [](CellComplex& c) {
         c.vertices[4] = {2, 1.2};
       }},
      {"edge 4: has no line", [](CellComplex& c) { c.vertices[6].x() = -1; }},
  };
  for (const Case& broken : cases) {
    CellComplex complex = three_faces();
    broken.harm(complex);
    const std::string violation = find_violation(complex);
    EXPECT_NE(violation.find(broken.message), std::string::npos)
        << broken.message << " but got: " << violation;
  }
}

TEST(FindViolation, AGapOrASecondPartIsNotATiling) {
  // A second copy beside the first: every side matches, but the box between them is not filled.
  CellComplex complex = three_faces();
  const CellComplex other = three_faces();
  for (const Vec2& p : other.vertices) {
    complex.vertices.push_back(p + Vec2(10, 0));
  }
  for (CellComplex::Edge edge : other.edges) {
    edge.v0 += 8;
    edge.v1 += 8;
    edge.left += edge.left < 0 ? 0 : 3;
    edge.right += edge.right < 0 ? 0 : 3;
    edge.line += edge.line < 0 ? 0 : 2;
    complex.edges.push_back(edge);
  }
  complex.lines.push_back({"w3", {0, 11}, 0, 2, {}});
  complex.lines.push_back(other.lines[1]);
  for (std::size_t i = 0; i < other.face_vertex.size(); ++i) {
    complex.face_vertex.push_back(other.face_vertex[i] + 8);
    complex.face_edge.push_back(other.face_edge[i] + 10);
  }
  complex.face_offset.insert(complex.face_offset.end(), {18, 22, 26});
  EXPECT_NE(find_violation(complex).find("no side of the bounding box"), std::string::npos)
      << find_violation(complex);
}

}  // namespace
}  // namespace roomcut

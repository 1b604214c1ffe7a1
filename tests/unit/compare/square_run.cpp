// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/compare/square_run.h"

namespace roomcut::compare {

WallLine wall(const std::string& id, const Vec2& a, const Vec2& b) {
  WallLine line;
  line.id = id;
  line.a = a;
  line.b = b;
  return line;
}

RunFacts square_run(const std::string& name, double width) {
  RunFacts run;
  run.name = name;
  run.scan_sha256 = "5ca9";
  run.parameters = {{"graphcut.mu_m", "0.3"}};
  run.lines = {wall("w0001", {0, 0}, {width, 0}), wall("w0002", {width, 0}, {width, 4}),
               wall("w0003", {width, 4}, {0, 4}), wall("w0004", {0, 4}, {0, 0})};
  // Faces of a grid of 3 x 3; the middle one is the room.
  RunPlan plan;
  CellComplex& complex = plan.complex;
  complex.levels = {0, 3};
  const double xs[] = {-1, 0, width, 9}, ys[] = {-1, 0, 4, 5};
  for (const double y : ys) {
    for (const double x : xs) {
      complex.vertices.emplace_back(x, y);
    }
  }
  complex.face_offset = {0};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const int v = 4 * row + column;
      for (const int corner : {v, v + 1, v + 5, v + 4}) {
        complex.face_vertex.push_back(corner);
      }
      complex.face_offset.push_back(static_cast<std::int64_t>(complex.face_vertex.size()));
    }
  }
  complex.edges = {{5, 6, 4, 1, 0}, {6, 10, 4, 5, 1}, {10, 9, 4, 7, 2}, {9, 5, 4, 3, 3}};
  plan.labels.label = {0, 0, 0, 0, 1, 0, 0, 0, 0};
  plan.labels.unobserved.assign(9, 0);
  run.plan = plan;
  SpaceFacts storey{0, 0, {0, 0}, 0, 3, 4 * width, 12 * width, 3, 0};
  run.storeys = {storey};
  storey.centre = {width / 2, 2};
  run.rooms = {storey};
  run.totals = {{"rooms", 1}, {"area_m2", 4 * width}};
  return run;
}

}  // namespace roomcut::compare

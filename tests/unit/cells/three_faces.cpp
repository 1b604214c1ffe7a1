// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/cells/three_faces.h"

#include <numbers>

namespace roomcut {

CellComplex three_faces() {
  CellComplex complex;
  complex.levels = {0, 2.5, 3};
  complex.vertices = {{0, 0}, {1, 0}, {4, 0}, {4, 1}, {4, 2}, {1, 2}, {0, 2}, {1, 1}};
  complex.edges = {{0, 1, 0, -1, -1}, {1, 7, 0, 1, 0},   {7, 5, 0, 2, 0},   {5, 6, 0, -1, -1},
                   {6, 0, 0, -1, -1}, {1, 2, 1, -1, -1}, {2, 3, 1, -1, -1}, {3, 7, 1, 2, 1},
                   {3, 4, 2, -1, -1}, {4, 5, 2, -1, -1}};
  complex.face_offset = {0, 5, 9, 13};
  complex.face_vertex = {0, 1, 7, 5, 6, 1, 2, 3, 7, 7, 3, 4, 5};
  complex.face_edge = {0, 1, 2, 3, 4, 5, 6, 7, 1, 7, 8, 9, 2};
  complex.lines = {{"w0001", {0, 1}, 0, 2, {}}, {"büro 2", {0.5 * std::numbers::pi, 1}, -4, -1, {1}}};
  return complex;
}

}  // namespace roomcut

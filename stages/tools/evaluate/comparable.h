// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"

namespace roomcut::evaluate {

/// A mesh as it came from a file, for messages.
struct NamedBox {
  std::string name;
  Bounds3 box;
};

/// Throws StageError(kMeshesUnlike) when two meshes cannot be of one building in one unit and frame: when all
/// three sides of their boxes differ by the factor of a unit (mm, cm, inches, feet; within a tenth), their
/// diagonals by a factor of 100, or when the boxes do not meet. The hint names the likely cause and the
/// remedy. Distances between such meshes say nothing, and may take for ever.
void require_comparable(const NamedBox& model, const NamedBox& truth);

}  // namespace roomcut::evaluate

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"
#include "stages/tools/synthesize/building.h"

namespace roomcut::synthesize {

/// The border of the union of the building's prisms: closed, oriented (normals out of the empty space, into
/// the wall), 2-manifold. Plan coordinates of new corners (where a jamb meets a wall) are the exact ones,
/// rounded once to double; heights are the prisms' own. Few triangles: walls are split only where another
/// surface has a corner. Throws StageError(kSceneInvalid), all problems at once: rooms that overlap, that
/// touch without a wall or slab between them, that meet in an edge or a corner only, doorways that reach into
/// a third room.
TriangleMesh make_truth(const Scene& scene, const Building& building);

/// "" or what is wrong: open or over-used edges, vertices where two sheets touch.
std::string find_defect(const TriangleMesh& mesh);

}  // namespace roomcut::synthesize

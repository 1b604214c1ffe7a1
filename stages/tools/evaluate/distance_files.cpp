// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "common/artefact/atomic_file.h"
#include "common/mesh/mesh_io.h"
#include "common/picture/colour_map.h"
#include "common/picture/render.h"
#include "stages/tools/evaluate/evaluate_io.h"

namespace roomcut::evaluate {

void write_distance_ply(const std::filesystem::path& path, const DistanceMesh& mesh, const ComparedAxes& axes,
                        double range_m) {
  VertexExtras extras;
  for (const double distance : mesh.distance_m) {
    const Colour colour = sequential_colour(distance / range_m);
    extras.colour.push_back({colour.r, colour.g, colour.b});
    extras.distance_m.push_back(static_cast<float>(distance));
  }
  TriangleMesh as_the_files = mesh.mesh;
  for (Vec3& vertex : as_the_files.vertices) {
    vertex = axes.turn.transpose() * vertex;
  }
  write_text_file(path, ply_bytes(as_the_files, axes.origin,
                                  {"distance to the truth in metres; cut up for display"}, extras));
}

void write_distance_png(const std::filesystem::path& path, const DistanceMesh& mesh, double range_m) {
  Drawing drawing;
  drawing.vertices.assign(mesh.mesh.vertices.begin(), mesh.mesh.vertices.end());
  for (const Triangle& t : mesh.mesh.triangles) {
    drawing.triangles.push_back(t);
    double farthest = 0;
    for (const std::int32_t v : t) {
      farthest = std::max(farthest, mesh.distance_m[static_cast<std::size_t>(v)]);
    }
    drawing.triangle_colours.push_back(sequential_colour(farthest / range_m));
  }
  write_png(path, render(drawing, View{}));
}

}  // namespace roomcut::evaluate

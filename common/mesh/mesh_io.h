// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace roomcut {

/// Reads a mesh from PLY (ascii, binary of either byte order, any further elements and properties), OFF or
/// OBJ; the format is recognised by the file's beginning, OBJ by its name. Faces with more than three corners
/// are triangulated by triangulate_polygon(). Face properties `kind`, `storey`, `region` of a PLY are taken
/// over when all are there. Vertices are kept as they stand (see weld_vertices()). Errors: kMeshUnreadable
/// (missing, folder, permission), kMeshFormat (anything wrong inside, with line or byte; files that promise
/// more than they hold are refused before memory is asked for; vertices 500 km from the rest; above 1 GiB).
TriangleMesh read_mesh(const std::filesystem::path& path);
/// The same from the file's content; `name` stands in messages and its extension tells an OBJ.
TriangleMesh parse_mesh(std::string_view content, const std::string& name);

/// Per-vertex additions to a PLY; each empty or one per vertex.
struct VertexExtras {
  std::vector<std::array<std::uint8_t, 3>> colour;  ///< red, green, blue
  std::vector<float> distance_m;
};

/// Binary little-endian PLY: double coordinates with `origin` added, int32 corners, per face kind, storey and
/// region when the mesh has them. `comments` go into the header, one line each.
std::string ply_bytes(const TriangleMesh& mesh, const Vec3& origin, const std::vector<std::string>& comments,
                      const VertexExtras& extras = {});
/// OFF text; numbers in the shortest form that reads back exactly.
std::string off_text(const TriangleMesh& mesh, const Vec3& origin);

/// A named group of an OBJ file: polygons over one shared list of vertices.
struct ObjGroup {
  std::string name;
  std::vector<std::vector<std::int32_t>> polygons;  ///< 0-based
};
/// OBJ text with `g` groups; numbers as off_text().
std::string obj_text(const std::vector<Vec3>& vertices, const std::vector<ObjGroup>& groups,
                     const Vec3& origin, const std::vector<std::string>& comments);

}  // namespace roomcut

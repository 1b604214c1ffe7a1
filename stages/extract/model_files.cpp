// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/model_files.h"

#include <map>
#include <sstream>
#include <utility>

#include "common/artefact/atomic_file.h"
#include "common/artefact/frame_crs.h"
#include "common/geometry/level_turn.h"
#include "common/mesh/mesh_io.h"

namespace roomcut::extract {

namespace {

Vec3 origin_of(const Frame& frame) {
  return {frame.origin[0], frame.origin[1], frame.origin[2]};
}

/// Vertices turned back to where the scan had them, but for the origin.
std::vector<Vec3> turned_back(std::vector<Vec3> vertices, const Frame& frame) {
  if (frame.levelled()) {
    const Eigen::Matrix3d back = level_turn(frame.level).transpose();
    for (Vec3& vertex : vertices) {
      vertex = back * vertex;
    }
  }
  return vertices;
}

/// What a model says of itself, one line each; the coordinate system where the scan names one.
std::vector<std::string> comments_of(const Frame& frame) {
  std::vector<std::string> comments = {"roomcut model: metres, z up, normals point out of the empty space"};
  if (crs_of(frame) == frame.crs) {
    std::string words;
    std::istringstream text(frame.crs);
    for (std::string word; text >> word;) {
      words += " " + word;
    }
    comments.push_back("coordinate system:" + words);
  }
  return comments;
}

}  // namespace

bool write_model_ply(const std::filesystem::path& path, const Model& model, const Frame& frame) {
  TriangleMesh mesh = model.surface.mesh;
  mesh.vertices = turned_back(std::move(mesh.vertices), frame);
  std::vector<std::string> comments = comments_of(frame);
  comments.emplace_back("kind: 0 floor, 1 ceiling, 2 wall; storey: 0 = lowest");
  return write_text_file(path, ply_bytes(mesh, origin_of(frame), comments));
}

bool write_model_obj(const std::filesystem::path& path, const Model& model, const Frame& frame) {
  std::map<std::pair<int, SurfaceKind>, ObjGroup> groups;
  for (const SurfaceRegion& region : model.surface.regions) {
    ObjGroup& group = groups[{region.storey, region.kind}];
    group.name = "storey_" + std::to_string(region.storey) + "_" + to_string(region.kind);
    group.polygons.insert(group.polygons.end(), region.polygons.begin(), region.polygons.end());
  }
  std::vector<ObjGroup> sorted;
  sorted.reserve(groups.size());
  for (auto& [key, group] : groups) {
    sorted.push_back(std::move(group));
  }
  return write_text_file(path, obj_text(turned_back(model.surface.mesh.vertices, frame), sorted,
                                        origin_of(frame), comments_of(frame)));
}

}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <string>

#include "common/cloud/cloud_io.h"
#include "common/errors/codes.h"
#include "common/geometry/level_turn.h"
#include "common/mesh/mesh_io.h"
#include "stages/tools/report/page_blocks.h"
#include "stages/tools/report/page_points.h"

namespace roomcut::report {

namespace {

/// Numbers of regions become indices here; extract counts them from 0.
void check_regions(const TriangleMesh& model, const std::filesystem::path& path) {
  for (const std::int32_t region : model.region) {
    if (region < 0 || static_cast<std::size_t>(region) >= model.triangles.size()) {
      throw StageError(errors::kMeshFormat, path.string(),
                       "a face belongs to region " + std::to_string(region) + ", which no model has",
                       "`make run` makes it again");
    }
  }
}

/// The model in local metres: model.ply has the frame's origin added, and stands as the scan does.
TriangleMesh local_model(const StageRun& run, const Frame& frame) {
  TriangleMesh model = read_mesh(run.input("model"));
  check_regions(model, run.input("model"));
  const Eigen::Matrix3d turn = level_turn(frame.level);
  for (Vec3& vertex : model.vertices) {
    vertex = turn * (vertex - Vec3(frame.origin[0], frame.origin[1], frame.origin[2]));
  }
  return model;
}

PageBlock model_block(const TriangleMesh& model, const std::vector<MeshTree::Hit>& nearest) {
  PageBlockBuilder block("model");
  std::vector<float> vertices;
  for (const Vec3& vertex : model.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      vertices.push_back(static_cast<float>(vertex[axis]));
    }
  }
  std::vector<std::int32_t> triangles;
  for (const Triangle& triangle : model.triangles) {
    triangles.insert(triangles.end(), triangle.begin(), triangle.end());
  }
  block.add("vertices", vertices);
  block.add("triangles", triangles);
  block.add("kind", model.kind);
  block.add("storey", model.storey);
  block.add("region", model.region);
  if (!nearest.empty() && !model.region.empty()) {
    const auto regions =
        static_cast<std::size_t>(*std::max_element(model.region.begin(), model.region.end()) + 1);
    block.add("region_distance", region_distances(nearest, model, regions));
  }
  return block.finish();
}

PageBlock cloud_block(const CloudHeader& header, const std::vector<ThinPoint>& points,
                      const std::vector<MeshTree::Hit>& nearest) {
  PageBlockBuilder block("cloud");
  const PagePoints packed = pack_points(points, nearest);
  block.facts["low"] = {packed.low.x(), packed.low.y(), packed.low.z()};
  block.facts["step"] = {packed.step.x(), packed.step.y(), packed.step.z()};
  block.facts["points"] = header.points;
  block.facts["distance_step_m"] = kDistanceStep_m;
  block.facts["stations"] = Json::array();
  for (const Vec3& station : header.stations) {
    block.facts["stations"].push_back({station.x(), station.y(), station.z()});
  }
  block.add("xyz", packed.xyz);
  block.add("surface", packed.surface);
  block.add("distance", packed.distance);
  PageBlock finished = block.finish();
  finished.noisy = true;
  return finished;
}

}  // namespace

void add_model_blocks(const StageRun& run, const std::vector<ThinPoint>& points,
                      std::vector<PageBlock>& blocks) {
  if (!run.has_input("cloud")) {
    return;  // without it the frame is not known either
  }
  const CloudHeader header = CloudReader(run.input("cloud")).header();
  std::vector<MeshTree::Hit> nearest;
  if (run.has_input("model")) {
    const TriangleMesh model = local_model(run, header.frame);
    if (!model.triangles.empty()) {
      nearest = nearest_of_model(points, model);
    }
    blocks.push_back(model_block(model, nearest));
  }
  blocks.push_back(cloud_block(header, points, nearest));
}

}  // namespace roomcut::report

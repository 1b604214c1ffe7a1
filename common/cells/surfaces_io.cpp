// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/surfaces_io.h"

#include "common/artefact/limits.h"
#include "common/cells/evidence_io.h"

// The page of this artefact is schemas/surfaces.md.

namespace roomcut {

namespace {

constexpr double kSteepest = 100;  // rise per metre: 89.4°; what is steeper is a wall
constexpr double kMostPoints = 1e15;

std::size_t level_faces(const CellComplex& complex) {
  return complex.levels.size() * complex.faces();
}

}  // namespace

LevelSurfaces read_surfaces(const std::filesystem::path& path, const CellsFile& cells) {
  const H5Reader file = open_for_cells(path, artefacts::kSurfaces, cells);
  const auto gradient = read_in_range<double>(file, "surface/gradient", {0, 2}, -kSteepest, kSteepest);
  const std::size_t count = gradient.size() / 2;
  const auto c = read_in_range<double>(file, "surface/c", {count}, -(1 + 2 * kSteepest) * limits::kFarthest_m,
                                       (1 + 2 * kSteepest) * limits::kFarthest_m);
  const auto sigma = read_in_range<double>(file, "surface/sigma", {count}, 0, limits::kFarthest_m);
  const auto area = read_in_range<double>(file, "surface/area", {count}, 0, limits::kLargestArea_m2);
  const auto points = read_in_range<std::int64_t>(file, "surface/points", {count}, 0, kMostPoints);
  const auto plane = read_in_range<std::int32_t>(file, "surface/plane", {count}, -1,
                                                 static_cast<double>(cells.complex.planes.size()) - 1);
  LevelSurfaces surfaces;
  for (std::size_t i = 0; i < count; ++i) {
    surfaces.surfaces.push_back(
        {Vec2(gradient[2 * i], gradient[2 * i + 1]), c[i], sigma[i], area[i], points[i], plane[i]});
  }
  surfaces.of_face = read_in_range<std::int32_t>(file, "level/surface", {level_faces(cells.complex)}, -1,
                                                 static_cast<double>(count) - 1);
  return surfaces;
}

bool write_surfaces(const std::filesystem::path& path, const LevelSurfaces& surfaces, const CellsFile& cells,
                    const Provenance& provenance) {
  require_size(surfaces.of_face.size(), level_faces(cells.complex), "level/surface");
  std::vector<double> gradient;
  std::vector<double> c;
  std::vector<double> sigma;
  std::vector<double> area;
  std::vector<std::int64_t> points;
  std::vector<std::int32_t> plane;
  for (const LevelSurface& surface : surfaces.surfaces) {
    gradient.insert(gradient.end(), {surface.gradient.x(), surface.gradient.y()});
    c.push_back(surface.c);
    sigma.push_back(surface.sigma_m);
    area.push_back(surface.area_m2);
    points.push_back(surface.points);
    plane.push_back(surface.plane);
  }
  H5Writer file(path, artefacts::kSurfaces, provenance, cells.complex.frame);
  file.attribute("/", kCellsDigest, cells.payload_sha256);
  file.write("surface/gradient", std::span<const double>(gradient), {surfaces.surfaces.size(), 2}, "1",
             "rise per metre along x and y; (0, 0) = level");
  file.write("surface/c", c, "m", "height over the local origin: z = gradient . p + c");
  file.write("surface/sigma", sigma, "m", "standard deviation of its height at its middle");
  file.write("surface/area", area, "m^2", "its area in the plan");
  file.write("surface/points", points, "1", "points that it was fitted to; 0 = it follows another one");
  file.write("surface/plane", plane, "1",
             "the sloped plane of cells.h5 that it is a part of; -1 = it stands for a level");
  file.write("level/surface", surfaces.of_face, "1",
             "surface of the level face; -1 = it lies at its level, or is none of the model's");
  return file.commit();
}

}  // namespace roomcut

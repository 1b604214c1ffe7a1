// SPDX-License-Identifier: GPL-3.0-or-later
// 300 random buildings of all families at three levels of detail: whatever the evidence says, the model is
// closed, oriented, 2-manifold, free of self-intersections, and encloses just its empty cells; so it is with
// floors and ceilings at planes of their own, and under roofs. No scan: lines, levels and planes are the
// building's own, moved and doubled, and the evidence is the truth spoilt by chance, so that the cut leaves
// all sorts of corners to be repaired.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <numeric>
#include <string>

#include "common/cells/interfaces.h"
#include "common/mesh/mesh_check.h"
#include "common/random/counter_random.h"
#include "stages/extract/extract.h"
#include "stages/graphcut/graphcut.h"
#include "stages/partition/partition.h"
#include "stages/tools/synthesize/building.h"
#include "stages/tools/synthesize/families.h"
#include "stages/tools/synthesize/plan.h"
#include "tests/unit/graphcut/random_cells.h"

namespace roomcut {
using namespace roomcut::extract;
using namespace roomcut::graphcut;
using namespace roomcut::partition;
using namespace roomcut::synthesize;
using namespace roomcut::testing;

namespace {

/// Of each family; 50, for the 300 buildings of the README, take minutes: ROOMCUT_RANDOM_BUILDINGS=50.
std::uint64_t buildings() {
  const char* wanted = std::getenv("ROOMCUT_RANDOM_BUILDINGS");
  return wanted != nullptr ? std::stoull(wanted) : 10;
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double operator()() { return random_unit(seed_, 0x726d, counter_++); }
  double around() { return 2 * (*this)() - 1; }

 private:
  std::uint64_t seed_, counter_ = 0;
};

Building random_building(const std::string& family, std::uint64_t seed) {
  Scene scene;
  scene.name = family;
  FamilySpec spec;
  spec.family = family;
  spec.seed = seed;
  spec.doors = seed % 4 != 0;
  add_random_building(spec, scene);
  return place(scene);
}

/// The sides of all prisms, moved by up to `off_m`, a tenth of them a second time within 3 cm.
WallLines lines_of(const Building& building, double off_m, Draw& draw) {
  WallLines lines;
  lines.bbox_min = building.lo.head<2>();
  lines.bbox_max = building.hi.head<2>();
  const auto add = [&](const Vec2& a, const Vec2& b, double off) {
    const Vec2 along = (b - a).normalized();
    const Vec2 normal(-along.y(), along.x());
    WallLine line;
    line.id = "w" + std::to_string(100000 + lines.lines.size());
    line.a = a + off * draw.around() * normal;
    line.b = b + off * draw.around() * normal;
    line.support_m = line.length();
    lines.lines.push_back(line);
  };
  for (const Prism& prism : building.prisms) {
    for (std::size_t i = 0; i < prism.polygon.size(); ++i) {
      const Vec2& a = prism.polygon[i];
      const Vec2& b = prism.polygon[(i + 1) % prism.polygon.size()];
      add(a, b, off_m);
      if (draw() < 0.1) add(a, b, 0.03);
    }
  }
  return lines;
}

std::vector<double> levels_of(const Building& building, double off_m, Draw& draw) {
  std::vector<double> levels;
  for (const Prism& prism : building.prisms) {
    levels.push_back(prism.z0 + off_m * draw.around());
    levels.push_back(prism.z1 + off_m * draw.around());
  }
  std::sort(levels.begin(), levels.end());
  const auto near = [](double a, double b) { return b - a < 0.02; };
  levels.erase(std::unique(levels.begin(), levels.end(), near), levels.end());
  return levels;
}

/// Monopitch and gable roofs under the ceilings of some prisms, steep and gentle.
std::vector<SlopedPlane> random_roofs(const Building& building, Draw& draw) {
  std::vector<SlopedPlane> planes;
  for (const Prism& prism : building.prisms) {
    if (prism.z1 - prism.z0 < 1 || draw() < 0.6) continue;
    const double azimuth = 2 * std::numbers::pi * (draw() < 0.5 ? std::floor(4 * draw()) / 4 : draw());
    const Vec2 uphill = std::tan(draw() * 1.05) * Vec2(std::cos(azimuth), std::sin(azimuth));
    const Vec2 middle = std::accumulate(prism.polygon.begin(), prism.polygon.end(), Vec2(0, 0)) /
                        static_cast<double>(prism.polygon.size());
    const double z = prism.z0 + (0.4 + 0.6 * draw()) * (prism.z1 - prism.z0);
    const bool gable = draw() < 0.5;
    for (const double side : {1.0, -1.0}) {
      SlopedPlane plane;
      plane.gradient = side * uphill;
      plane.c = z - plane.gradient.dot(middle);
      plane.outline = prism.polygon;
      planes.push_back(plane);
      if (!gable) break;
    }
  }
  return planes;
}

/// Adds steps along the planes, 0.3 m apart.
Slopes with_steps(const std::vector<SlopedPlane>& planes, std::vector<double>& levels) {
  const std::vector<double> real = levels;
  for (const SlopedPlane& plane : planes) {
    const auto [low, high] = plane.range();
    for (double z = std::max(low, real.front()) + 0.15; z < std::min(high, real.back()); z += 0.3) {
      const bool near =
          std::any_of(levels.begin(), levels.end(), [&](double level) { return std::abs(level - z) < 0.1; });
      if (!near) levels.push_back(z);
    }
  }
  std::sort(levels.begin(), levels.end());
  Slopes slopes{planes, {}};
  for (const double z : levels) {
    slopes.steps.push_back(std::binary_search(real.begin(), real.end(), z) ? 0 : 1);
  }
  return slopes;
}

/// Whether a point lies under all planes that cover it.
bool is_under_roofs(const std::vector<SlopedPlane>& planes, const Vec3& p) {
  return std::all_of(planes.begin(), planes.end(), [&](const SlopedPlane& plane) {
    return !plane.covers(p.head<2>(), 0) || p.z() < plane.height(p.head<2>());
  });
}

/// Ceilings near a plane follow it, a little refitted; the other floors and ceilings of a level lie up to 2
/// cm beside it and lean by up to 0.5 %.
LevelSurfaces random_surfaces(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                              Draw& draw) {
  LevelSurfaces out;
  const auto jittered = [&](const Vec2& gradient, double c, double tilt, double off) {
    LevelSurface surface;
    surface.gradient = gradient + tilt * Vec2(draw.around(), draw.around());
    surface.c = c + off * draw.around();
    out.surfaces.push_back(surface);
  };
  for (const SlopedPlane& plane : complex.planes) jittered(plane.gradient, plane.c, 3e-4, 0.003);
  for (const double z : complex.levels) {
    jittered({0, 0}, z, 0.005, 0.02);
    jittered({0, 0}, z, 0, 0.02);
  }
  for (std::size_t i = 0; i < complex.levels.size() * complex.faces(); ++i) {
    const std::size_t level = complex.level_of(i);
    const bool below = level > 0 && is_empty(label, i - complex.faces());
    const bool above = level < complex.layers() && is_empty(label, i);
    out.of_face.push_back(-1);
    if (above == below || draw() < 0.05) continue;
    const Vec2 middle = complex.centroid(complex.face_of_level(i));
    out.of_face[i] = static_cast<std::int32_t>(complex.planes.size() + 2 * level + (above ? 1 : 0));
    for (std::size_t p = 0; below && p < complex.planes.size(); ++p) {
      if (complex.planes[p].covers(middle, 0.3) &&
          std::abs(complex.planes[p].height(middle) - complex.levels[level]) < 0.2) {
        out.of_face[i] = static_cast<std::int32_t>(p);
      }
    }
  }
  return out;
}

std::vector<float> truth_beta(const CellComplex& complex, const Building& building) {
  std::vector<float> beta(complex.cells(), 0.08F);
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
    const Vec3 p = complex.centre(cell);
    for (const Prism& prism : building.prisms) {
      if (p.z() > prism.z0 && p.z() < prism.z1 && contains(prism.polygon, p.head<2>()) &&
          is_under_roofs(complex.planes, p))
        beta[cell] = 0.92F;
    }
  }
  return beta;
}

/// Most of the truth's surfaces are covered, little else.
FaceWeights truth_weights(const CellComplex& complex, const std::vector<float>& beta, Draw& draw) {
  FaceWeights weights = no_weights(complex);
  const auto empty = [&](std::int64_t cell) {
    return cell >= 0 && beta[static_cast<std::size_t>(cell)] > 0.5F;
  };
  for_each_interface(complex, [&](const Interface& face) {
    const double omega = empty(face.a) != empty(face.b) ? 1 - 0.7 * draw() : 0.2 * draw();
    (face.wall ? weights.wall_omega : weights.level_omega)[face.index] = static_cast<float>(omega);
  });
  return weights;
}

class RandomModels : public ::testing::TestWithParam<std::string> {};

TEST_P(RandomModels, AreValidAndEncloseJustTheirEmptyCells) {
  int models = 0;
  std::int64_t repaired = 0;
  double area = 0, put_back = 0;
  for (std::uint64_t seed = 1; seed <= buildings(); ++seed) {
    Draw draw(seed);
    const Building building = random_building(GetParam(), seed);
    const double off_m = std::array{0.0, 0.003, 0.02}[seed % 3];
    const WallLines lines = lines_of(building, off_m, draw);
    std::vector<double> levels = levels_of(building, off_m, draw);
    const Slopes slopes =
        with_steps(seed % 2 == 0 ? random_roofs(building, draw) : std::vector<SlopedPlane>{}, levels);
    const CellComplex complex = partition::partition(lines, levels, {}, slopes).complex;
    ASSERT_EQ(find_violation(complex), "") << GetParam() << seed;
    std::vector<float> beta = truth_beta(complex, building);
    const FaceWeights weights = truth_weights(complex, beta, draw);
    const double spoilt = std::array{0.0, 0.03, 0.15, 0.4}[seed % 4];
    for (float& b : beta) {
      if (draw() < spoilt) b = static_cast<float>(draw());
    }
    const DataTerms terms = terms_of(complex, beta);
    for (const double mu : {0.05, 0.3, 1.0}) {
      SCOPED_TRACE(GetParam() + " " + std::to_string(seed) + ", mu " + std::to_string(mu));
      GraphcutParams params;
      params.mu_m = mu;
      const Labels labels = graphcut::graphcut(complex, weights, terms, params).labels;
      const Model model = extract_model(complex, labels, {}, {});
      EXPECT_EQ(model.fault, "");
      const MeshCheck check = check_mesh(model.surface.mesh);
      EXPECT_TRUE(check.valid()) << describe_faults(check);
      double empty = 0;
      for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
        if (is_empty(labels.label, cell)) empty += complex.volume(cell);
      }
      EXPECT_NEAR(check.volume_m3, empty, 1e-7 * empty);  // how much of it is rounding: extract checks
      const Model sloped =
          extract_model(complex, labels, {}, {}, random_surfaces(complex, labels.label, draw));
      EXPECT_EQ(sloped.fault, "");
      EXPECT_TRUE(sloped.check.valid()) << describe_faults(sloped.check);
      EXPECT_NEAR(sloped.check.volume_m3, sloped.empty_m3,
                  1e-4 * (1 + sloped.areas.floor + sloped.areas.ceiling));
      area += sloped.areas.floor + sloped.areas.ceiling;
      put_back += sloped.put_back_m2;
      ++models;
      repaired += labels.repair_flips > 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(models, static_cast<int>(3 * buildings()));
  EXPECT_GT(repaired, models / 10);  // the corners that need repair do come up
  std::cout << GetParam() << ": " << models << " models, " << repaired << " of them repaired; " << put_back
            << " of " << area << " m2 of floors and ceilings put back\n";
  EXPECT_LT(put_back, 0.05 * area);
}

INSTANTIATE_TEST_SUITE_P(All, RandomModels, ::testing::ValuesIn(family_names()),
                         [](const auto& family) { return family.param; });

}  // namespace
}  // namespace roomcut

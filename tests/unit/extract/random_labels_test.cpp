// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "common/cells/vertex_rings.h"
#include "common/random/counter_random.h"
#include "stages/extract/extract.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::extract {
namespace {

// The cells around (vertex, level) as places on a circle of faces times two layers, -1 = outside.
struct Neighbourhood {
  std::vector<std::int64_t> below, above;
};

Neighbourhood around(const CellComplex& complex, const VertexRings& rings, std::size_t vertex,
                     std::size_t level) {
  Neighbourhood out;
  for (const std::int32_t face : rings.faces_around(vertex)) {
    const auto cell = [&](bool inside, std::size_t layer) -> std::int64_t {
      return face >= 0 && inside
                 ? static_cast<std::int64_t>(complex.cell(static_cast<std::size_t>(face), layer))
                 : -1;
    };
    out.below.push_back(level > 0 ? cell(true, level - 1) : -1);
    out.above.push_back(cell(level < complex.layers(), level));
  }
  return out;
}

// How many connected pieces the cells with one label make; neighbours share a face.
int pieces(const Neighbourhood& n, const std::vector<std::uint8_t>& label, std::uint8_t wanted) {
  const std::size_t size = n.below.size();
  std::vector<int>
      todo;  // 1 = has the label and was not reached yet; first the layer below, then the one above
  for (const auto& cells : {n.below, n.above}) {
    for (const std::int64_t cell : cells) {
      todo.push_back((cell < 0 ? 0 : label[static_cast<std::size_t>(cell)]) == wanted ? 1 : 0);
    }
  }
  const std::function<void(std::size_t, std::size_t)> reach = [&](std::size_t layer, std::size_t place) {
    int& here = todo[layer * size + place];
    if (here == 0) return;
    here = 0;
    reach(layer, place + 1 == size ? 0 : place + 1);
    reach(layer, place == 0 ? size - 1 : place - 1);
    reach(1 - layer, place);
  };
  int count = 0;
  for (std::size_t layer = 0; layer < 2; ++layer) {
    for (std::size_t place = 0; place < size; ++place) {
      count += todo[layer * size + place];
      reach(layer, place);
    }
  }
  return count;
}

// Empties all cells around places that are not 2-manifold until there is none: only ever solid -> empty, so
// it ends.
void make_manifold(const CellComplex& complex, std::vector<std::uint8_t>& label) {
  const VertexRings rings = vertex_rings(complex);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
      for (std::size_t l = 0; l < complex.levels.size(); ++l) {
        const Neighbourhood n = around(complex, rings, v, l);
        if (pieces(n, label, 0) <= 1 && pieces(n, label, 1) <= 1) continue;
        for (const auto& cells : {n.below, n.above}) {
          for (const std::int64_t cell : cells) {
            if (cell >= 0) label[static_cast<std::size_t>(cell)] = 1;
          }
        }
        changed = true;
      }
    }
  }
}

/// A random complex and a labelling of it whose surface is a 2-manifold.
struct RandomCells {
  CellComplex complex;
  Labels labels;

  explicit RandomCells(std::uint64_t seed) {
    auto draw = [seed, counter = std::uint64_t{0}]() mutable { return random_unit(seed, 0, counter++); };
    const auto coordinates = [&](int n) {
      std::vector<double> out{-3};
      for (int i = 1; i < n; ++i) out.push_back(out.back() + 0.05 + draw() * draw());
      return out;
    };
    const auto x = coordinates(9), y = coordinates(8), z = coordinates(6);
    // Never 45 degrees: the sides of the bounding box are told apart by their direction.
    const double angle = seed % 2 == 0 ? 0 : 0.7 * draw();
    complex = test::grid_complex(x, y, z, angle, [seed](int i, int j) {
      return i % 2 == 0 &&
             random_unit(seed, 1, 64 * static_cast<std::uint64_t>(i) + static_cast<std::uint64_t>(j)) < 0.3;
    });
    if (angle == 0) {  // turned grids have no axis-aligned bounding box, all else holds
      EXPECT_EQ(find_violation(complex), "");
    }
    labels =
        test::label_where(complex, [&](const Vec2&, double) { return draw() < 0.02 + 0.1 * (seed % 5); });
    labels.label[complex.cell(complex.faces() / 2, 2)] = 1;
    make_manifold(complex, labels.label);
  }
};

TEST(Extract, TwoHundredRandomLabelingsAreClosedAndFreeOfIntersections) {
  std::set<std::int64_t> eulers;
  std::set<std::int64_t> sizes;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RandomCells cells(seed);
    const Model model = extract_model(cells.complex, cells.labels, {}, {});
    ASSERT_EQ(model.fault, "") << "seed " << seed;
    ASSERT_TRUE(model.check.valid()) << "seed " << seed << ": " << describe_faults(model.check);
    eulers.insert(model.check.euler);
    sizes.insert(model.check.triangles);
  }
  EXPECT_GT(eulers.size(), 8U) << "the labelings are of many kinds";
  EXPECT_GT(sizes.size(), 60U);
}

/// How floors and ceilings differ from their levels.
struct Wildness {
  double offset_m, tilt;
  int planes;      ///< per level and side
  double go_back;  ///< share of them that may have to lie at their levels
};

/// Random planes for the floors and ceilings: faces of one level and side share `planes` of them at random.
LevelSurfaces random_surfaces(const RandomCells& cells, std::uint64_t seed, const Wildness& wild) {
  const CellComplex& complex = cells.complex;
  auto draw = [seed, counter = std::uint64_t{0}]() mutable {
    return 2 * random_unit(seed, 2, counter++) - 1;
  };
  LevelSurfaces out;
  out.of_face.assign(complex.levels.size() * complex.faces(), -1);
  for (std::size_t i = 0; i < out.of_face.size(); ++i) {
    const std::size_t level = complex.level_of(i);
    const bool below = level > 0 && is_empty(cells.labels.label, i - complex.faces());
    const bool above = level < complex.layers() && is_empty(cells.labels.label, i);
    if (above == below || draw() > 0.8) continue;
    const auto kind = 2 * static_cast<int>(level) + (above ? 1 : 0);
    const auto of_kind = static_cast<int>(wild.planes * random_unit(seed, 3, i));
    out.of_face[i] = kind * wild.planes + of_kind;
  }
  for (std::size_t kind = 0; kind < 2 * complex.levels.size(); ++kind) {
    for (int i = 0; i < wild.planes; ++i) {
      LevelSurface surface;
      if (draw() > -0.5) surface.gradient = wild.tilt * Vec2(draw(), draw());
      surface.c = complex.levels[kind / 2] + wild.offset_m * draw();
      out.surfaces.push_back(surface);
    }
  }
  return out;
}

TEST(Extract, RandomSurfacesLeaveRandomLabelingsClosedAndFreeOfIntersections) {
  // As fits give them; as one level's faces at random from several; slopes; and nonsense.
  for (const Wildness& wild :
       {Wildness{0.03, 0.01, 1, 0.02}, Wildness{0.03, 0.01, 3, 0.2}, Wildness{1e-4, 1e-4, 3, 0.4},
        Wildness{0.1, 0.3, 1, 0.15}, Wildness{0.3, 2, 2, 1}}) {
    double area = 0, put_back = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", tilt " + std::to_string(wild.tilt));
      const RandomCells cells(seed);
      const LevelSurfaces surfaces = random_surfaces(cells, seed, wild);
      const Model model = extract_model(cells.complex, cells.labels, {}, {}, surfaces);
      ASSERT_EQ(model.fault, "");
      ASSERT_TRUE(model.check.valid()) << describe_faults(model.check);
      EXPECT_NEAR(model.check.volume_m3, model.empty_m3, 1e-4 * model.empty_m3);
      area += model.areas.floor + model.areas.ceiling;
      put_back += model.put_back_m2;
    }
    EXPECT_LE(put_back, wild.go_back * area) << wild.offset_m << " " << wild.tilt << " " << wild.planes;
  }
}

}  // namespace
}  // namespace roomcut::extract

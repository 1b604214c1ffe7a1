// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include "common/cells/vertex_rings.h"
#include "common/random/counter_random.h"
#include "stages/extract/extract.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut {
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

int pieces(const Neighbourhood& n, const std::vector<std::uint8_t>& label, std::uint8_t wanted) {
  const std::size_t size = n.below.size();
  const auto value = [&](std::size_t place) {
    const std::int64_t cell = place < size ? n.below[place] : n.above[place - size];
    return cell < 0 ? std::uint8_t{0} : label[static_cast<std::size_t>(cell)];
  };
  std::vector<int> seen(2 * size, 0);
  int count = 0;
  for (std::size_t seed = 0; seed < 2 * size; ++seed) {
    if (seen[seed] != 0 || value(seed) != wanted) continue;
    ++count;
    std::vector<std::size_t> open{seed};
    seen[seed] = 1;
    while (!open.empty()) {
      const std::size_t p = open.back();
      open.pop_back();
      const std::size_t layer = p / size * size;
      for (const std::size_t q :
           {layer + (p + 1) % size, layer + (p + size - 1) % size, (p + size) % (2 * size)}) {
        if (seen[q] == 0 && value(q) == wanted) {
          seen[q] = 1;
          open.push_back(q);
        }
      }
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

TEST(Extract, TwoHundredRandomLabelingsAreClosedAndFreeOfIntersections) {
  std::set<std::int64_t> eulers;
  std::set<std::int64_t> sizes;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    auto draw = [seed, counter = std::uint64_t{0}]() mutable { return random_unit(seed, 0, counter++); };
    const auto coordinates = [&](int n) {
      std::vector<double> out{-3};
      for (int i = 1; i < n; ++i) out.push_back(out.back() + 0.05 + draw() * draw());
      return out;
    };
    const auto x = coordinates(9), y = coordinates(8), z = coordinates(6);
    // Never 45 degrees: the sides of the bounding box are told apart by their direction.
    const double angle = seed % 2 == 0 ? 0 : 0.7 * draw();
    const CellComplex complex = test::grid_complex(x, y, z, angle, [seed](int i, int j) {
      return i % 2 == 0 && random_unit(seed, 1, static_cast<std::uint64_t>(64 * i + j)) < 0.3;
    });
    if (angle == 0) {  // turned grids have no axis-aligned bounding box, all else holds
      ASSERT_EQ(find_violation(complex), "");
    }
    Labels labels =
        test::label_where(complex, [&](const Vec2&, double) { return draw() < 0.02 + 0.1 * (seed % 5); });
    labels.label[complex.cell(complex.faces() / 2, 2)] = 1;
    make_manifold(complex, labels.label);
    const Model model = extract_model(complex, labels, {});
    ASSERT_EQ(model.fault, "") << "seed " << seed;
    ASSERT_TRUE(model.check.valid()) << "seed " << seed << ": " << describe_faults(model.check);
    eulers.insert(model.check.euler);
    sizes.insert(model.check.triangles);
  }
  EXPECT_GT(eulers.size(), 8U) << "the labelings are of many kinds";
  EXPECT_GT(sizes.size(), 60U);
}

}  // namespace
}  // namespace roomcut

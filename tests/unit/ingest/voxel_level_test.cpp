// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/voxel_level.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

#include "stages/ingest/coverage.h"
#include "stages/ingest/tile_grid.h"

namespace roomcut::ingest {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

/// Random points in tile (2, -3) and its halo.
TilePoints random_points(std::size_t count) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<float> x(12.4F, 19.6F);
  std::uniform_real_distribution<float> y(-19.6F, -12.4F);
  std::uniform_real_distribution<float> z(-1.0F, 1.5F);
  TilePoints points;
  for (std::size_t i = 0; i < count; ++i) {
    points.x.push_back(x(random));
    points.y.push_back(y(random));
    points.z.push_back(z(random));
  }
  return points;
}

using Key = std::tuple<int, int, int>;  ///< column x, column y, height

/// Occupied voxels with their counts, found the slow way.
std::map<Key, std::uint32_t> counts_of(const VoxelLevel& level) {
  std::map<Key, std::uint32_t> counts;
  for (int iy = 0; iy < level.columns; ++iy) {
    for (int ix = 0; ix < level.columns; ++ix) {
      for (std::uint32_t v = level.begin[level.column(ix, iy)]; v < level.begin[level.column(ix, iy) + 1];
           ++v) {
        counts[{ix, iy, level.z[v]}] += level.moments[v].points();
      }
    }
  }
  return counts;
}

class VoxelLevels : public ::testing::Test {
 protected:
  VoxelLevels() {
    grid_.build({run_of(points_)},
                TilePlace{2, -3, -32, {kAll, kAll, kAll, kAll, kAll, kAll, kAll, kAll, kAll}}, scale_);
  }
  UnitScale scale_{0.05};
  TilePoints points_ = random_points(20'000);
  TileGrid grid_;
};

TEST_F(VoxelLevels, hold_every_point_once_in_its_voxel) {
  std::map<Key, std::uint32_t> expected;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::int32_t base = -24;  // voxels: the multiple of 8 at or below -1.0 m
    ++expected[{(scale_.units(points_.x[i]) >> 10) - (2 * 128 - 8),
                (scale_.units(points_.y[i]) >> 10) - (-3 * 128 - 8),
                (scale_.units(points_.z[i]) >> 10) - base}];
  }
  EXPECT_EQ(counts_of(grid_.level(0)), expected);
  EXPECT_EQ(grid_.points().size(), points_.size());
}

TEST_F(VoxelLevels, join_eight_voxels_to_one) {
  for (int i = 0; i + 1 < fixed_grid::kLevels; ++i) {
    std::map<Key, std::uint32_t> expected;
    for (const auto& [key, count] : counts_of(grid_.level(i))) {
      expected[{std::get<0>(key) / 2, std::get<1>(key) / 2, std::get<2>(key) / 2}] += count;
    }
    EXPECT_EQ(counts_of(grid_.level(i + 1)), expected) << i;
    std::vector<std::uint32_t> sums(grid_.level(i + 1).size(), 0);
    for (std::size_t v = 0; v < grid_.level(i).size(); ++v) {
      sums[grid_.level(i).parent[v]] += grid_.level(i).moments[v].points();
    }
    for (std::size_t v = 0; v < sums.size(); ++v) {
      ASSERT_EQ(sums[v], grid_.level(i + 1).moments[v].points()) << i;
    }
  }
}

TEST_F(VoxelLevels, count_neighbourhoods_as_the_slow_way_does) {
  for (int i = 0; i < fixed_grid::kLevels; ++i) {
    const VoxelLevel& level = grid_.level(i);
    const std::map<Key, std::uint32_t> counts = counts_of(level);
    for (const auto& [key, count] : counts) {
      const auto [ix, iy, iz] = key;
      const bool inside = std::min(ix, iy) >= level.halo() && std::max(ix, iy) < level.columns - level.halo();
      std::uint32_t expected = 0;
      for (int k = 0; inside && k < 27; ++k) {
        const auto found = counts.find({ix + k % 3 - 1, iy + k / 3 % 3 - 1, iz + k / 9 - 1});
        expected += found == counts.end() ? 0 : found->second;
      }
      std::uint32_t sum = 0;
      VoxelMask mask = 0;
      Neighbourhood(level, ix, iy).visit(static_cast<std::uint16_t>(iz), [&](std::uint32_t voxel, int bit) {
        sum += level.moments[voxel].points();
        mask |= VoxelMask{1} << bit;
      });
      EXPECT_NE(mask & VoxelMask{1} << 13, 0U) << "the voxel itself is in the middle";
      ASSERT_TRUE(!inside || sum == expected) << "level " << i << " at " << ix << " " << iy << " " << iz;
    }
  }
}

TEST_F(VoxelLevels, leave_out_the_layers_that_are_not_kept) {
  TilePlace place{2, -3, -32, {}};
  place.layers[4] = std::uint64_t{1} << 32;  // only heights 0 … 6.4 m of the tile itself
  grid_.build({run_of(points_)}, place, scale_);
  std::size_t expected = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::int32_t tx = scale_.units(points_.x[i]) >> 17;
    const std::int32_t ty = scale_.units(points_.y[i]) >> 17;
    expected += tx == 2 && ty == -3 && points_.z[i] >= 0 ? 1 : 0;
  }
  EXPECT_EQ(grid_.points().size(), expected);
}

}  // namespace
}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/find_openings/wall_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "stages/find_openings/robust_position.h"

namespace roomcut::find_openings {

namespace {

constexpr double kPad_m =
    0.05;  // the head of an opening up to the ceiling scatters about the top of the wall

template <class T>
std::vector<T> values(const std::unique_ptr<std::atomic<T>[]>& sums, std::size_t size) {
  std::vector<T> result(size);
  for (std::size_t i = 0; i < size; ++i) {
    result[i] = sums[i].load(std::memory_order_relaxed);
  }
  return result;
}

}  // namespace

struct WallEvidence::Sums {
  const RoomWall* wall = nullptr;
  Vec2 normal, direction;                      // of face a, the normal into the wall
  double offset = 0;                           // depth = normal · p - offset
  double thickness0 = 0, thickness_slope = 0;  // thickness(t) = thickness0 + slope · t
  double reach_m = 0;                          // of the whole wall: largest thickness + margin
  double z0 = 0, z1 = 0, row_m = 0, bin_m = 0;
  std::size_t rows = 0, z_bins = 0;
  std::unique_ptr<std::atomic<std::uint32_t>[]> face_a, face_b;
  std::unique_ptr<std::atomic<std::uint64_t>[]> jambs, heads;
};

WallEvidence::WallEvidence(const std::vector<RoomWall>& walls, const std::vector<double>& levels,
                           const EvidenceSettings& settings)
    : margin_m_(settings.margin_m) {
  for (const RoomWall& wall : walls) {
    auto sums = std::make_unique<Sums>();
    sums->wall = &wall;
    sums->normal = wall.side * wall.a.normal();
    sums->direction = wall.a.direction();
    sums->offset = wall.side * wall.a.d;
    sums->thickness0 = wall.thickness(0);
    sums->thickness_slope = wall.thickness(1) - sums->thickness0;
    sums->reach_m = std::max(wall.thickness(wall.t0()), wall.thickness(wall.t1())) + margin_m_;
    std::size_t lowest = wall.layers;
    std::size_t highest = 0;
    for (std::size_t k = 0; k < wall.layers; ++k) {
      for (std::size_t c = 0; c < wall.columns; ++c) {
        if (wall.stands(c, k)) {
          lowest = std::min(lowest, k);
          highest = std::max(highest, k);
        }
      }
    }
    sums->z0 = levels[lowest] - kPad_m;
    sums->z1 = levels[highest + 1] + kPad_m;
    sums->row_m = settings.row_m;
    sums->bin_m = wall.step_m / static_cast<double>(WallRasters::kFine);
    sums->rows = static_cast<std::size_t>(std::ceil((sums->z1 - sums->z0) / sums->row_m));
    sums->z_bins = static_cast<std::size_t>(std::ceil((sums->z1 - sums->z0) / sums->bin_m));
    const std::size_t cells = wall.columns * sums->rows;
    sums->face_a = std::make_unique<std::atomic<std::uint32_t>[]>(cells);
    sums->face_b = std::make_unique<std::atomic<std::uint32_t>[]>(cells);
    sums->jambs = std::make_unique<std::atomic<std::uint64_t>[]>(cells * WallRasters::kFine);
    sums->heads = std::make_unique<std::atomic<std::uint64_t>[]>(wall.columns * sums->z_bins);
    sums_.push_back(std::move(sums));
  }
}

WallEvidence::~WallEvidence() = default;

/// Whether a wall meets the box.
bool WallEvidence::meets(const Sums& sums, const Vec2& low, const Vec2& high) const {
  const Vec2 centre = 0.5 * (low + high);
  const Vec2 half = 0.5 * (high - low);
  const double depth = sums.normal.dot(centre) - sums.offset;
  const double across = sums.normal.cwiseAbs().dot(half);
  const double t = sums.direction.dot(centre);
  const double along = sums.direction.cwiseAbs().dot(half);
  return depth + across >= -margin_m_ && depth - across <= sums.reach_m && t + along >= sums.wall->t0() &&
         t - along <= sums.wall->t1();
}

/// The walls near a tile, sorted into the cells of a grid: most points have none.
struct WallEvidence::Near {
  static constexpr int kCells = 16;  // along each side
  Vec2 low{0, 0}, cell{1, 1};
  bool any = false;
  std::array<std::vector<const Sums*>, std::size_t{kCells} * kCells> walls;

  const std::vector<const Sums*>& at(double x, double y) const {
    const int ix = std::min(kCells - 1, static_cast<int>((x - low.x()) / cell.x()));
    const int iy = std::min(kCells - 1, static_cast<int>((y - low.y()) / cell.y()));
    return walls[index(ix, iy)];
  }
  static std::size_t index(int ix, int iy) {
    return static_cast<std::size_t>(iy) * kCells + static_cast<std::size_t>(ix);
  }
};

WallEvidence::Near WallEvidence::walls_near(const CloudTile& tile) const {
  constexpr double kFar = std::numeric_limits<double>::max();
  constexpr double kRounding = 1e-6;  // [m] of a point at the border of a cell
  Vec2 low(kFar, kFar);
  Vec2 high(-kFar, -kFar);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const Vec2 p(tile.x[i], tile.y[i]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Near near;
  near.low = low;
  near.cell = ((high - low) / Near::kCells).cwiseMax(kRounding);
  for (const auto& sums : sums_) {
    if (tile.size() == 0 || !meets(*sums, low, high)) {
      continue;
    }
    near.any = true;
    for (int iy = 0; iy < Near::kCells; ++iy) {
      for (int ix = 0; ix < Near::kCells; ++ix) {
        const Vec2 corner = low + near.cell.cwiseProduct(Vec2(ix, iy));
        if (meets(*sums, corner.array() - kRounding, (corner + near.cell).array() + kRounding)) {
          near.walls[Near::index(ix, iy)].push_back(sums.get());
        }
      }
    }
  }
  return near;
}

void WallEvidence::add_point(const Sums& sums, const Vec2& p, double z) const {
  const double depth = sums.normal.dot(p) - sums.offset;
  if (depth < -margin_m_ || depth > sums.reach_m || z < sums.z0 || z >= sums.z1) {
    return;
  }
  const double along = sums.direction.dot(p);
  const double t = along / sums.wall->step_m - static_cast<double>(sums.wall->first);
  if (t < 0 || t >= static_cast<double>(sums.wall->columns)) {
    return;
  }
  const double thickness = sums.thickness0 + sums.thickness_slope * along;
  const double margin = std::min(margin_m_, thickness / 3);
  const auto column = static_cast<std::size_t>(t);
  const std::size_t row = std::min(sums.rows - 1, static_cast<std::size_t>((z - sums.z0) / sums.row_m));
  if (std::abs(depth) <= margin) {
    sums.face_a[column * sums.rows + row].fetch_add(1, std::memory_order_relaxed);
  } else if (std::abs(depth - thickness) <= margin) {
    sums.face_b[column * sums.rows + row].fetch_add(1, std::memory_order_relaxed);
  } else if (depth > 0 && depth < thickness) {
    const double fine = t * static_cast<double>(WallRasters::kFine);
    const std::size_t bin =
        std::min(sums.wall->columns * WallRasters::kFine - 1, static_cast<std::size_t>(fine));
    sums.jambs[bin * sums.rows + row].fetch_add(BinSum::pack(std::min(1.0, fine - static_cast<double>(bin))),
                                                std::memory_order_relaxed);
    const double up = (z - sums.z0) / sums.bin_m;
    const std::size_t z_bin = std::min(sums.z_bins - 1, static_cast<std::size_t>(up));
    sums.heads[column * sums.z_bins + z_bin].fetch_add(
        BinSum::pack(std::min(1.0, up - static_cast<double>(z_bin))), std::memory_order_relaxed);
  }
}

void WallEvidence::add(const CloudTile& tile) {
  const Near near = walls_near(tile);
  if (!near.any) {
    return;
  }
  for (std::size_t i = 0; i < tile.size(); ++i) {
    for (const Sums* sums : near.at(tile.x[i], tile.y[i])) {
      add_point(*sums, Vec2(tile.x[i], tile.y[i]), tile.z[i]);
    }
  }
  points_.fetch_add(tile.size(), std::memory_order_relaxed);
}

WallRasters WallEvidence::rasters(std::size_t wall) const {
  const Sums& sums = *sums_[wall];
  WallRasters result;
  result.z0 = sums.z0;
  result.row_m = sums.row_m;
  result.bin_m = sums.bin_m;
  result.columns = sums.wall->columns;
  result.rows = sums.rows;
  result.z_bins = sums.z_bins;
  const std::size_t cells = result.columns * result.rows;
  result.face_a = values(sums.face_a, cells);
  result.face_b = values(sums.face_b, cells);
  result.jambs = values(sums.jambs, cells * WallRasters::kFine);
  result.heads = values(sums.heads, result.columns * result.z_bins);
  return result;
}

}  // namespace roomcut::find_openings

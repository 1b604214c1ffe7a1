// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/observe.h"

#include <algorithm>
#include <cmath>

#include "common/robust/robust_offset.h"

namespace roomcut::fit_surfaces {
namespace {

constexpr std::uint32_t kFewestPoints = 4;
constexpr double kMargin_m = 0.03;
constexpr double kMarginNoise = 4;  // times the noise
constexpr double kFinestBin_m = 0.0015;
constexpr double kBinNoise = 0.5;       // times the noise
constexpr double kExpectedWeight = 10;  // of the cloud's noise in that of a patch, in points
// Places in a patch are summed in 1/256 of the grid's cell, x in the upper half of a sum and y in the lower.
constexpr double kPlaces = 256;
constexpr int kPlaceBits = 32;

}  // namespace

SurfaceObserver::SurfaceObserver(const CellComplex& complex, const Seats& seats, double patch_m,
                                 double reach_m, double noise_m)
    : seats_(seats),
      raster_(complex, patch_m, std::max(kMargin_m, kMarginNoise * noise_m)),
      reach_m_(reach_m),
      noise_m_(noise_m),
      bins_(static_cast<std::size_t>(std::ceil(2 * reach_m / std::max(kFinestBin_m, kBinNoise * noise_m)))) {
  std::size_t patches = 0;
  for (std::size_t i = 0; i < raster_.pieces(); ++i) {
    first_patch_.push_back(patches);
    patches += seats.of_face(static_cast<std::size_t>(raster_.piece(i).face)).size();
  }
  first_patch_.push_back(patches);
  histograms_ = std::make_unique<std::atomic<Sum*>[]>(patches);
}

SurfaceObserver::~SurfaceObserver() {
  for (std::size_t i = 0; i < first_patch_.back(); ++i) {
    delete[] histograms_[i].load(std::memory_order_relaxed);
  }
}

/// Its bins and, behind them, the sum of places.
SurfaceObserver::Sum* SurfaceObserver::histogram(std::size_t patch) {
  Sum* sums = histograms_[patch].load(std::memory_order_acquire);
  if (sums == nullptr) {
    Sum* fresh = new Sum[bins_ + 1]();
    if (histograms_[patch].compare_exchange_strong(sums, fresh, std::memory_order_acq_rel)) {
      return fresh;
    }
    delete[] fresh;  // another thread was first
  }
  return sums;
}

void SurfaceObserver::add(const CloudTile& tile) {
  const double per_bin = static_cast<double>(bins_) / (2 * reach_m_);
  const PlanGrid& grid = raster_.grid();
  std::uint64_t taken = 0;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const auto surface = static_cast<SurfaceClass>(tile.surface[i]);
    if (surface == SurfaceClass::kWall) {
      continue;
    }
    const Vec2 p(tile.x[i], tile.y[i]);
    const std::int64_t found = raster_.find(p);
    if (found < 0) {
      continue;
    }
    const auto piece = static_cast<std::size_t>(found);
    const std::span<const Seat> seats = seats_.of_face(static_cast<std::size_t>(raster_.piece(piece).face));
    double nearest = reach_m_;
    double offset = 0;
    std::size_t best = seats.size();
    for (std::size_t k = 0; k < seats.size(); ++k) {
      const double off = seats[k].cosine * (tile.z[i] - seats[k].height(p));
      if (std::abs(off) < nearest && (surface != SurfaceClass::kSloped || seats[k].plane >= 0)) {
        nearest = std::abs(off);
        offset = off;
        best = k;
      }
    }
    if (best == seats.size()) {
      continue;
    }
    Sum* sums = histogram(first_patch_[piece] + best);
    const double position = (offset + reach_m_) * per_bin;
    const std::size_t bin = std::min(bins_ - 1, static_cast<std::size_t>(position));
    sums[bin].fetch_add(OffsetHistogram::pack(position - static_cast<double>(bin)),
                        std::memory_order_relaxed);
    const Vec2 place = kPlaces / grid.cell * (p - grid.low);
    const auto x = static_cast<std::uint64_t>(place.x() - kPlaces * grid.column(p.x()));
    const auto y = static_cast<std::uint64_t>(place.y() - kPlaces * grid.row(p.y()));
    sums[bins_].fetch_add((x << kPlaceBits) + y, std::memory_order_relaxed);
    ++taken;
  }
  points_.fetch_add(taken, std::memory_order_relaxed);
}

std::vector<Observation> SurfaceObserver::observations() const {
  std::vector<Observation> result;
  std::vector<std::uint64_t> bins(bins_);
  const PlanGrid& grid = raster_.grid();
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const auto columns = static_cast<std::size_t>(grid.nx);
    const Vec2 corner =
        grid.low + grid.cell * Vec2(static_cast<double>(cell % columns), static_cast<double>(cell / columns));
    for (std::size_t piece = raster_.first(cell); piece < raster_.first(cell + 1); ++piece) {
      const std::size_t seat = seats_.first(static_cast<std::size_t>(raster_.piece(piece).face));
      for (std::size_t patch = first_patch_[piece]; patch < first_patch_[piece + 1]; ++patch) {
        const Sum* sums = histograms_[patch].load();
        if (sums == nullptr) {
          continue;
        }
        std::uint64_t all = 0;
        for (std::size_t k = 0; k < bins_; ++k) {
          bins[k] = sums[k].load();
          all += OffsetHistogram::count(bins[k]);
        }
        const RobustOffset found = robust_offset(bins, reach_m_, noise_m_);
        if (found.points < kFewestPoints) {
          continue;
        }
        const std::uint64_t places = sums[bins_].load();
        const Vec2 mean(static_cast<double>(places >> kPlaceBits),
                        static_cast<double>(places & ((std::uint64_t{1} << kPlaceBits) - 1)));
        const std::size_t of = seat + (patch - first_patch_[piece]);
        const double cosine = seats_[of].cosine;
        const double n = found.points;
        const double noise2 =
            (n * found.scatter_m2 + kExpectedWeight * noise_m_ * noise_m_) / (n + kExpectedWeight);
        result.push_back(
            {of, corner + grid.cell / kPlaces * (mean / static_cast<double>(all) + Vec2(0.5, 0.5)),
             found.offset_m / cosine, found.variance_m2 * noise2 / (noise_m_ * noise_m_ * cosine * cosine),
             found.scatter_m2, raster_.piece(piece).area, found.points});
      }
    }
  }
  return result;
}

}  // namespace roomcut::fit_surfaces

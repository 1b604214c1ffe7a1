// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/observe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

namespace roomcut {

namespace {

constexpr double kAzimuthFits_rad = 17.0 * std::numbers::pi / 180.0;
constexpr std::uint32_t kFewestPoints = 4;
constexpr double kPatchPoints = 20;
constexpr double kLowestZone_m = 0.5;
constexpr double kTypicalBin_m = 0.1;
constexpr double kEdge_m =
    0.10;  ///< points without a plane this near a level belong to the edge of floor or ceiling

/// Whether the strip of `half` around the segment can meet the box.
bool strip_meets_box(const Line2& line, double t0, double t1, double half, const Vec2& low,
                     const Vec2& high) {
  const Vec2 centre = 0.5 * (low + high);
  const Vec2 reach = 0.5 * (high - low);
  const Vec2 n = line.normal().cwiseAbs();
  const Vec2 u = line.direction().cwiseAbs();
  const double t = line.along(centre);
  return std::abs(line.distance(centre)) <= n.dot(reach) + half && t + u.dot(reach) >= t0 &&
         t - u.dot(reach) <= t1;
}

}  // namespace

/// The lines near one tile, with what the inner loop needs of them.
struct LineObserver::Near {
  const Track* track;
  const LineFaces* faces;
  Vec2 normal, direction;
};

/// Which lines pass near each block of a tile: a point then asks a few instead of all that cross the tile.
class LineObserver::Neighbourhood {
 public:
  Neighbourhood(const CloudTile& tile, const std::vector<LineFaces>& lines, const std::vector<Track>& tracks,
                double band_m) {
    if (tile.size() == 0) {
      return;
    }
    const auto [x0, x1] = std::minmax_element(tile.x.begin(), tile.x.end());
    const auto [y0, y1] = std::minmax_element(tile.y.begin(), tile.y.end());
    low_ = Vec2(*x0, *y0);
    columns_ = static_cast<std::size_t>((*x1 - *x0) / kBlock_m) + 1;
    const std::size_t rows = static_cast<std::size_t>((*y1 - *y0) / kBlock_m) + 1;
    std::vector<Near> crossing;
    for (const Track& track : tracks) {
      const Line2& line = lines[track.line].line;
      crossing.push_back({&track, &lines[track.line], line.normal(), line.direction()});
    }
    const auto keep_near = [&](const Vec2& low, const Vec2& high, const std::vector<Near>& from,
                               std::vector<Near>& to) {
      std::copy_if(from.begin(), from.end(), std::back_inserter(to), [&](const Near& near) {
        return strip_meets_box(near.faces->line, near.faces->t0, near.faces->t1, band_m, low, high);
      });
    };
    std::vector<Near> of_tile;
    keep_near(low_, Vec2(*x1, *y1), crossing, of_tile);
    std::vector<Near> of_row;
    const Vec2 rounding = Vec2::Constant(1e-6);
    for (std::size_t row = 0; row < rows; ++row) {
      const Vec2 corner = low_ + Vec2(0, static_cast<double>(row) * kBlock_m);
      of_row.clear();
      keep_near(corner - rounding, Vec2(*x1, corner.y() + kBlock_m) + rounding, of_tile, of_row);
      for (std::size_t column = 0; column < columns_; ++column) {
        const Vec2 low = corner + Vec2(static_cast<double>(column) * kBlock_m, 0);
        keep_near(low - rounding, low + Vec2::Constant(kBlock_m) + rounding, of_row, near_);
        end_.push_back(near_.size());
      }
    }
  }

  bool empty() const { return near_.empty(); }
  std::span<const Near> near(float x, float y) const {
    const auto column = static_cast<std::size_t>((x - low_.x()) / kBlock_m);
    const auto row = static_cast<std::size_t>((y - low_.y()) / kBlock_m);
    const std::size_t block = row * columns_ + column;
    const std::size_t first = block == 0 ? 0 : end_[block - 1];
    return {near_.data() + first, end_[block] - first};
  }

 private:
  static constexpr double kBlock_m = 0.5;
  Vec2 low_{0, 0};
  std::size_t columns_ = 0;
  std::vector<Near> near_;        ///< block by block, ascending
  std::vector<std::size_t> end_;  ///< of each block's in near_
};

/// A point's place on the line that it belongs to.
struct LineObserver::Hit {
  std::int32_t patch = -1;
  double offset = 0;  ///< from the line [m]
  double along = 0;   ///< from the bin's start [m]
};

LineObserver::LineObserver(const std::vector<LineFaces>& lines, const std::vector<bool>& active,
                           const std::vector<double>& levels, double band_m, double noise_m, double density)
    : lines_(lines), levels_(levels), band_m_(band_m), noise_m_(noise_m) {
  const double wanted = std::max(kLowestZone_m, kPatchPoints / (std::max(density, 1.0) * kTypicalBin_m));
  first_zone_.push_back(0);
  for (std::size_t layer = 0; layer + 1 < levels.size(); ++layer) {
    const double height = levels[layer + 1] - levels[layer];
    first_zone_.push_back(first_zone_.back() +
                          static_cast<std::size_t>(std::max(1.0, std::round(height / wanted))));
  }
  zones_ = first_zone_.back();
  std::int32_t patches = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (active[i] && lines[i].bins > 0) {
      tracks_.push_back(make_track(i, patches));
    }
  }
  track_of_.assign(lines.size(), tracks_.size());
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    track_of_[tracks_[k].line] = k;
  }
  histograms_ = std::make_unique<std::atomic<std::uint64_t>[]>(static_cast<std::size_t>(patches) *
                                                               OffsetHistogram::kBins);
  along_ = std::make_unique<std::atomic<std::int64_t>[]>(static_cast<std::size_t>(patches));
}

LineObserver::Track LineObserver::make_track(std::size_t line, std::int32_t& patches) const {
  const LineFaces& faces = lines_[line];
  Track track{line, std::vector<std::int32_t>(faces.bins * zones_, -1), {}};
  for (std::size_t bin = 0; bin < faces.bins; ++bin) {
    for (std::size_t layer = 0; layer < faces.layers; ++layer) {
      if (faces.side_at(bin, layer) != 0) {
        for (std::size_t zone = first_zone_[layer]; zone < first_zone_[layer + 1]; ++zone) {
          track.patch[bin * zones_ + zone] = 0;
        }
      }
    }
  }
  for (std::int32_t& patch : track.patch) {
    patch = patch < 0 ? -1 : patches++;
  }
  for (int step = 0; step < kAzimuthSteps; ++step) {
    const double azimuth = azimuth_of(static_cast<std::uint8_t>(step));
    track.fits.push_back(angle_between(azimuth, faces.line.theta) <= kAzimuthFits_rad ? 1 : 0);
  }
  return track;
}

std::size_t LineObserver::zone_of(double z, std::size_t layer) const {
  const std::size_t count = first_zone_[layer + 1] - first_zone_[layer];
  const double share = (z - levels_[layer]) / (levels_[layer + 1] - levels_[layer]);
  const auto zone = static_cast<std::size_t>(std::max(0.0, share * static_cast<double>(count)));
  return first_zone_[layer] + std::min(count - 1, zone);
}

LineObserver::Hit LineObserver::find_line(const CloudTile& tile, std::size_t i,
                                          std::span<const Near> near) const {
  Hit hit;
  const auto surface = static_cast<SurfaceClass>(tile.surface[i]);
  const double z = tile.z[i];
  const auto above = std::upper_bound(levels_.begin(), levels_.end(), z);
  if (surface == SurfaceClass::kHorizontal || above == levels_.begin() || above == levels_.end()) {
    return hit;
  }
  const bool upright = surface == SurfaceClass::kWall;
  if (!upright && (*above - z < kEdge_m || z - *(above - 1) < kEdge_m)) {
    return hit;
  }
  const auto layer = static_cast<std::size_t>(above - levels_.begin()) - 1;
  const Vec2 p(tile.x[i], tile.y[i]);
  double nearest = band_m_;
  for (const Near& candidate : near) {
    const LineFaces& faces = *candidate.faces;
    const double e = candidate.normal.dot(p) - faces.line.d;
    if (std::abs(e) >= nearest || (upright && candidate.track->fits[tile.azimuth[i]] == 0)) {
      continue;
    }
    const double t = (candidate.direction.dot(p) - faces.t0) / faces.bin_m;
    if (t < 0 || t >= static_cast<double>(faces.bins)) {
      continue;
    }
    const auto bin = static_cast<std::size_t>(t);
    if (faces.side_at(bin, layer) != 0) {
      nearest = std::abs(e);
      hit = {candidate.track->patch[bin * zones_ + zone_of(z, layer)], e,
             (t - static_cast<double>(bin)) * faces.bin_m};
    }
  }
  return hit;
}

void LineObserver::add(const CloudTile& tile) {
  const Neighbourhood lines(tile, lines_, tracks_, band_m_);
  if (lines.empty()) {
    return;
  }
  const double per_bin = OffsetHistogram::kBins / (2 * band_m_);
  std::uint64_t taken = 0;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const Hit hit = find_line(tile, i, lines.near(tile.x[i], tile.y[i]));
    if (hit.patch < 0) {
      continue;
    }
    const auto patch = static_cast<std::size_t>(hit.patch);
    const double position = (hit.offset + band_m_) * per_bin;
    const int bin = std::clamp(static_cast<int>(position), 0, OffsetHistogram::kBins - 1);
    histograms_[patch * OffsetHistogram::kBins + static_cast<std::size_t>(bin)].fetch_add(
        OffsetHistogram::pack(position - bin), std::memory_order_relaxed);
    along_[patch].fetch_add(static_cast<std::int64_t>(hit.along * 1e6 + 0.5), std::memory_order_relaxed);
    ++taken;
  }
  points_.fetch_add(taken, std::memory_order_relaxed);
}

std::vector<Observation> LineObserver::observations(std::size_t i) const {
  std::vector<Observation> result;
  if (track_of_[i] == tracks_.size()) {
    return result;
  }
  const Track& track = tracks_[track_of_[i]];
  const LineFaces& faces = lines_[i];
  std::array<std::uint64_t, OffsetHistogram::kBins> histogram{};
  std::size_t layer = 0;
  for (std::size_t zone = 0; zone < zones_; ++zone) {
    layer += zone == first_zone_[layer + 1] ? 1 : 0;
    for (std::size_t bin = 0; bin < faces.bins; ++bin) {
      if (track.patch[bin * zones_ + zone] < 0) {
        continue;
      }
      const auto patch = static_cast<std::size_t>(track.patch[bin * zones_ + zone]);
      std::uint32_t count = 0;
      for (std::size_t k = 0; k < histogram.size(); ++k) {
        histogram[k] = histograms_[patch * OffsetHistogram::kBins + k].load();
        count += OffsetHistogram::count(histogram[k]);
      }
      const RobustOffset found = robust_offset(histogram, band_m_, noise_m_);
      if (found.points >= kFewestPoints) {
        const double along = 1e-6 * static_cast<double>(along_[patch].load()) / count;
        const double t = faces.t0 + static_cast<double>(bin) * faces.bin_m + along;
        result.push_back({faces.line.at(t) + found.offset_m * faces.line.normal(), found.variance_m2,
                          found.scatter_m2, found.points, static_cast<int>(zone), bin, layer});
      }
    }
  }
  return result;
}

}  // namespace roomcut

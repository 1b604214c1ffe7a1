// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/observe.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace roomcut::refine_lines {

namespace {

constexpr std::uint32_t kFewestPoints = 4;
constexpr double kPatchPoints = 20;
constexpr double kLowestZone_m = 0.5;
constexpr double kTypicalBin_m = 0.1;
constexpr double kPerMetre = 1e6;  ///< units in which places along a line are summed
constexpr double kHalf = 0.5;      ///< makes truncation round: what is rounded is never negative
constexpr double kEdge_m =
    0.10;  ///< points without a plane this near a level belong to the edge of floor or ceiling

}  // namespace

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
  for (const LineTrack& track : tracks_) {
    const Line2& line = lines[track.line].line;
    all_lines_.push_back({&track, &lines[track.line], line.normal(), line.direction()});
  }
  track_of_.assign(lines.size(), tracks_.size());
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    track_of_[tracks_[k].line] = k;
  }
  histograms_ =
      std::make_unique<std::atomic<std::uint64_t>[]>(static_cast<std::size_t>(patches) * kOffsetBins);
  along_ = std::make_unique<std::atomic<std::int64_t>[]>(static_cast<std::size_t>(patches));
}

LineTrack LineObserver::make_track(std::size_t line, std::int32_t& patches) const {
  const LineFaces& faces = lines_[line];
  LineTrack track{line, std::vector<std::int32_t>(faces.bins * zones_, -1), {}};
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
  track.fits = azimuths_on(faces.line.theta, kAzimuthFits_rad);
  return track;
}

std::size_t LineObserver::zone_of(double z, std::size_t layer) const {
  const std::size_t count = first_zone_[layer + 1] - first_zone_[layer];
  const double share = (z - levels_[layer]) / (levels_[layer + 1] - levels_[layer]);
  const auto zone = static_cast<std::size_t>(std::max(0.0, share * static_cast<double>(count)));
  return first_zone_[layer] + std::min(count - 1, zone);
}

LineObserver::Hit LineObserver::find_line(const CloudTile& tile, std::size_t i,
                                          std::span<const NearLine> near) const {
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
  for (const NearLine& candidate : near) {
    const LineFaces& faces = *candidate.faces;
    const double e = candidate.normal.dot(p) - faces.line.d;
    if (std::abs(e) >= nearest || (upright && !candidate.track->fits[tile.azimuth[i]])) {
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
  const LineNeighbourhood lines(tile, all_lines_, band_m_);
  if (lines.empty()) {
    return;
  }
  const double per_bin = kOffsetBins / (2 * band_m_);
  std::uint64_t taken = 0;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const Hit hit = find_line(tile, i, lines.near(tile.x[i], tile.y[i]));
    if (hit.patch < 0) {
      continue;
    }
    const auto patch = static_cast<std::size_t>(hit.patch);
    const double position = (hit.offset + band_m_) * per_bin;
    const int bin = std::clamp(static_cast<int>(position), 0, kOffsetBins - 1);
    histograms_[patch * kOffsetBins + static_cast<std::size_t>(bin)].fetch_add(
        OffsetHistogram::pack(position - bin), std::memory_order_relaxed);
    along_[patch].fetch_add(static_cast<std::int64_t>(hit.along * kPerMetre + kHalf),
                            std::memory_order_relaxed);
    ++taken;
  }
  points_.fetch_add(taken, std::memory_order_relaxed);
}

std::vector<Observation> LineObserver::observations(std::size_t i) const {
  std::vector<Observation> result;
  if (track_of_[i] == tracks_.size()) {
    return result;
  }
  const LineTrack& track = tracks_[track_of_[i]];
  const LineFaces& faces = lines_[i];
  std::array<std::uint64_t, kOffsetBins> histogram{};
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
        histogram[k] = histograms_[patch * kOffsetBins + k].load();
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

}  // namespace roomcut::refine_lines

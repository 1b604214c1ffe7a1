// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/observe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace roomcut {

namespace {

constexpr double kAzimuthFits_rad = 17.0 * std::numbers::pi / 180.0;
constexpr std::uint32_t kFewestPoints = 4;
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

LineObserver::LineObserver(const std::vector<LineFaces>& lines, const std::vector<bool>& active,
                           const std::vector<double>& levels, double band_m, double noise_m)
    : lines_(lines), levels_(levels), band_m_(band_m), noise_m_(noise_m) {
  std::size_t bins = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!active[i] || lines[i].bins == 0) {
      continue;
    }
    Track track{i, bins, {}};
    for (int step = 0; step < kAzimuthSteps; ++step) {
      const double azimuth = azimuth_of(static_cast<std::uint8_t>(step));
      track.fits.push_back(angle_between(azimuth, lines[i].line.theta) <= kAzimuthFits_rad ? 1 : 0);
    }
    tracks_.push_back(std::move(track));
    bins += lines[i].bins;
  }
  track_of_.assign(lines.size(), tracks_.size());
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    track_of_[tracks_[k].line] = k;
  }
  histograms_ = std::make_unique<std::atomic<std::uint64_t>[]>(bins * OffsetHistogram::kBins);
  along_ = std::make_unique<std::atomic<std::int64_t>[]>(bins);
}

std::vector<const LineObserver::Track*> LineObserver::tracks_near(const Vec2& low, const Vec2& high) const {
  std::vector<const Track*> near;
  for (const Track& track : tracks_) {
    const LineFaces& faces = lines_[track.line];
    if (strip_meets_box(faces.line, faces.t0, faces.t1, band_m_, low, high)) {
      near.push_back(&track);
    }
  }
  return near;
}

void LineObserver::add(const CloudTile& tile) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Vec2 low(kFar, kFar);
  Vec2 high(-kFar, -kFar);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const Vec2 p(tile.x[i], tile.y[i]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  struct Near {
    const Track* track;
    const LineFaces* faces;
    Vec2 normal, direction;
  };
  std::vector<Near> near;
  for (const Track* track : tracks_near(low, high)) {
    const LineFaces& faces = lines_[track->line];
    near.push_back({track, &faces, faces.line.normal(), faces.line.direction()});
  }
  if (near.empty()) {
    return;
  }
  const double per_bin = OffsetHistogram::kBins / (2 * band_m_);
  std::uint64_t taken = 0;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const auto surface = static_cast<SurfaceClass>(tile.surface[i]);
    if (surface == SurfaceClass::kHorizontal) {
      continue;
    }
    const bool upright = surface == SurfaceClass::kWall;
    const Vec2 p(tile.x[i], tile.y[i]);
    const auto above = std::upper_bound(levels_.begin(), levels_.end(), static_cast<double>(tile.z[i]));
    if (above == levels_.begin() || above == levels_.end()) {
      continue;
    }
    if (!upright && (*above - tile.z[i] < kEdge_m || tile.z[i] - *(above - 1) < kEdge_m)) {
      continue;
    }
    const auto layer = static_cast<std::size_t>(above - levels_.begin()) - 1;
    const Near* best = nullptr;
    double nearest = band_m_;
    double offset = 0;
    double along = 0;
    std::size_t place = 0;
    for (const Near& candidate : near) {
      const double e = candidate.normal.dot(p) - candidate.faces->line.d;
      if (std::abs(e) >= nearest || (upright && candidate.track->fits[tile.azimuth[i]] == 0)) {
        continue;
      }
      const double t = (candidate.direction.dot(p) - candidate.faces->t0) / candidate.faces->bin_m;
      if (t < 0 || t >= static_cast<double>(candidate.faces->bins)) {
        continue;
      }
      const auto bin = static_cast<std::size_t>(t);
      if (candidate.faces->side_at(bin, layer) == 0) {
        continue;
      }
      best = &candidate;
      nearest = std::abs(e);
      offset = e;
      along = (t - static_cast<double>(bin)) * candidate.faces->bin_m;
      place = candidate.track->first + bin;
    }
    if (best == nullptr) {
      continue;
    }
    const double position = (offset + band_m_) * per_bin;
    const int bin = std::clamp(static_cast<int>(position), 0, OffsetHistogram::kBins - 1);
    histograms_[place * OffsetHistogram::kBins + static_cast<std::size_t>(bin)].fetch_add(
        OffsetHistogram::pack(position - bin), std::memory_order_relaxed);
    along_[place].fetch_add(std::llround(along * 1e6), std::memory_order_relaxed);
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
  for (std::size_t bin = 0; bin < faces.bins; ++bin) {
    const std::size_t place = track.first + bin;
    std::uint32_t count = 0;
    for (std::size_t k = 0; k < histogram.size(); ++k) {
      histogram[k] = histograms_[place * OffsetHistogram::kBins + k].load();
      count += OffsetHistogram::count(histogram[k]);
    }
    if (count < kFewestPoints) {
      continue;
    }
    const RobustOffset found = robust_offset(histogram, band_m_, noise_m_);
    if (found.points >= kFewestPoints) {
      const double t = faces.t0 + static_cast<double>(bin) * faces.bin_m +
                       1e-6 * static_cast<double>(along_[place].load()) / count;
      result.push_back({faces.line.at(t) + found.offset_m * faces.line.normal(), found.variance_m2,
                        found.scatter_m2, found.points});
    }
  }
  return result;
}

}  // namespace roomcut

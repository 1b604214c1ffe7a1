// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/find_openings/reveal.h"

#include <algorithm>
#include <cmath>

#include "stages/find_openings/robust_position.h"

namespace roomcut::find_openings {

namespace {

constexpr std::uint32_t kFewestPoints = 8;
constexpr double kJambSpread = 0.45, kHeadSpread = 0.5;
constexpr double kOneJamb_m = 0.06;
constexpr double kNarrowestCut_m = 0.012;

/// The bins [first, last) of `low` … `high`, whole ones only.
std::pair<std::size_t, std::size_t> whole_bins(double low, double high, std::size_t count) {
  constexpr double kRounding = 1e-9;
  const auto most = static_cast<double>(count);
  const double first = std::clamp(std::ceil(low - kRounding), 0.0, most);
  const double last = std::clamp(std::floor(high + kRounding), first, most);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

/// Points within `window` bins of each bin of [range.first, range.second), 0 elsewhere.
std::vector<std::uint32_t> windowed(const std::vector<std::uint64_t>& profile, std::size_t window,
                                    const std::pair<std::size_t, std::size_t>& range) {
  std::vector<std::uint32_t> result(profile.size(), 0);
  for (std::size_t i = range.first; i < range.second; ++i) {
    for (std::size_t k = i >= window ? i - window : 0; k < std::min(profile.size(), i + window + 1); ++k) {
      result[i] += BinSum::count(profile[k]);
    }
  }
  return result;
}

}  // namespace

Reveal::Range Reveal::columns_within(double t0, double t1) const {
  return whole_bins((t0 - wall_.t0()) / wall_.step_m, (t1 - wall_.t0()) / wall_.step_m, r_.columns);
}

Reveal::Range Reveal::rows_within(double z0, double z1) const {
  return whole_bins((z0 - r_.z0) / r_.row_m, (z1 - r_.z0) / r_.row_m, r_.rows);
}

std::size_t Reveal::window_bins() const {
  return static_cast<std::size_t>(std::ceil(tolerances_.window_m() / r_.bin_m));
}

double Reveal::cut_bins() const {
  return std::max(3.5 * tolerances_.noise_m, kNarrowestCut_m) / r_.bin_m;
}

std::optional<Cover> Reveal::cover(double t0, double t1, double z0, double z1) const {
  const auto [c0, c1] = columns_within(t0, t1);
  const auto [row0, row1] = rows_within(z0, z1);
  if (c1 <= c0 || row1 <= row0) {
    return std::nullopt;
  }
  Cover cover;
  for (std::size_t c = c0; c < c1; ++c) {
    for (std::size_t row = row0; row < row1; ++row) {
      cover.face_a += r_.face_a[c * r_.rows + row] != 0 ? 1 : 0;
      cover.face_b += r_.face_b[c * r_.rows + row] != 0 ? 1 : 0;
      std::uint64_t inside = 0;
      for (std::size_t k = 0; k < WallRasters::kFine; ++k) {
        inside |= r_.jambs[(c * WallRasters::kFine + k) * r_.rows + row];
      }
      cover.inside += inside != 0 ? 1 : 0;
    }
  }
  const double cells = static_cast<double>((c1 - c0) * (row1 - row0));
  return Cover{cover.face_a / cells, cover.face_b / cells, cover.inside / cells};
}

/// Share of the rows with points within the window about the bin.
double Reveal::row_spread(std::size_t bin, const Range& bins, const Range& rows) const {
  const std::size_t window = window_bins();
  const std::size_t low = std::max(bins.first, bin >= window ? bin - window : 0);
  const std::size_t high = std::min(bins.second, bin + window + 1);
  std::size_t hit = 0;
  for (std::size_t row = rows.first; row < rows.second; ++row) {
    std::uint64_t any = 0;
    for (std::size_t k = low; k < high; ++k) {
      any |= r_.jambs[k * r_.rows + row];
    }
    hit += any != 0 ? 1 : 0;
  }
  return rows.second > rows.first ? static_cast<double>(hit) / static_cast<double>(rows.second - rows.first)
                                  : 0;
}

std::vector<RevealSurface> Reveal::find_jambs(const Stretch& stretch, double z0, double z1) const {
  const Range rows = rows_within(z0, z1);
  const Range bins{stretch.first * WallRasters::kFine, stretch.last * WallRasters::kFine};
  std::vector<std::uint64_t> profile(r_.columns * WallRasters::kFine, 0);
  for (std::size_t i = bins.first; i < bins.second; ++i) {
    for (std::size_t row = rows.first; row < rows.second; ++row) {
      profile[i] += r_.jambs[i * r_.rows + row];
    }
  }
  const std::vector<std::uint32_t> count = windowed(profile, window_bins(), bins);
  std::vector<std::size_t> peaks;
  for (std::size_t i = bins.first; i < bins.second; ++i) {
    if (count[i] >= kFewestPoints && row_spread(i, bins, rows) >= kJambSpread) {
      peaks.push_back(i);
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&](std::size_t a, std::size_t b) { return count[a] > count[b]; });
  std::vector<RevealSurface> jambs;
  for (const std::size_t peak : peaks) {
    const RobustPosition place =
        robust_position(profile, peak, window_bins(), cut_bins(), tolerances_.noise_m / r_.bin_m);
    const double t = wall_.t0() + place.at * r_.bin_m;
    const bool known = std::any_of(jambs.begin(), jambs.end(), [&](const RevealSurface& jamb) {
      return std::abs(jamb.at - t) < kOneJamb_m;
    });
    if (place.points >= kFewestPoints && !known) {
      const auto bin = std::min(bins.second - 1, static_cast<std::size_t>(place.at));
      jambs.push_back({t, {place.points, row_spread(bin, bins, rows), place.sigma * r_.bin_m}});
    }
  }
  std::sort(jambs.begin(), jambs.end(),
            [](const RevealSurface& a, const RevealSurface& b) { return a.at < b.at; });
  return jambs;
}

/// Share of the columns, two at a time, with points within the window about the bin.
double Reveal::column_spread(std::size_t bin, const Range& columns) const {
  const std::size_t window = window_bins();
  const std::size_t low = bin >= window ? bin - window : 0;
  const std::size_t high = std::min(r_.z_bins, bin + window + 1);
  std::size_t pairs = 0;
  std::size_t hit = 0;
  for (std::size_t c = columns.first; c + 1 < columns.second; c += 2, ++pairs) {
    std::uint64_t any = 0;
    for (std::size_t k = low; k < high; ++k) {
      any |= r_.heads[c * r_.z_bins + k] | r_.heads[(c + 1) * r_.z_bins + k];
    }
    hit += any != 0 ? 1 : 0;
  }
  return pairs > 0 ? static_cast<double>(hit) / static_cast<double>(pairs) : 0;
}

std::optional<RevealSurface> Reveal::find_head(double t0, double t1, double z0, double z1) const {
  const Range columns = columns_within(t0, t1);
  std::vector<std::uint64_t> profile(r_.z_bins, 0);
  for (std::size_t c = columns.first; c < columns.second; ++c) {
    for (std::size_t i = 0; i < r_.z_bins; ++i) {
      profile[i] += r_.heads[c * r_.z_bins + i];
    }
  }
  const Range bins = whole_bins((z0 - r_.z0) / r_.bin_m, (z1 - r_.z0) / r_.bin_m, r_.z_bins);
  const std::vector<std::uint32_t> count = windowed(profile, window_bins(), bins);
  const std::uint32_t strongest = *std::max_element(count.begin(), count.end());
  for (std::size_t i = bins.first; i < bins.second; ++i) {
    if (count[i] < kFewestPoints || 2 * count[i] < strongest || column_spread(i, columns) < kHeadSpread) {
      continue;
    }
    // The first bin that passes lies on the peak's lower flank.
    const std::size_t end = std::min(bins.second, i + 2 * window_bins() + 1);
    const auto peak =
        static_cast<std::size_t>(std::max_element(count.begin() + static_cast<std::ptrdiff_t>(i),
                                                  count.begin() + static_cast<std::ptrdiff_t>(end)) -
                                 count.begin());
    const RobustPosition place =
        robust_position(profile, peak, window_bins(), cut_bins(), tolerances_.noise_m / r_.bin_m);
    if (place.points < kFewestPoints) {
      return std::nullopt;
    }
    return RevealSurface{r_.z0 + place.at * r_.bin_m,
                         {place.points, column_spread(peak, columns), place.sigma * r_.bin_m}};
  }
  return std::nullopt;
}

}  // namespace roomcut::find_openings

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/hough_io.h"

#include <algorithm>
#include <cmath>

#include "common/artefact/h5.h"

namespace roomcut::detect_lines {
namespace {

constexpr double kVoteUnit = 0.001;  // m

/// Whole millimetres of support, as the picture does not need more.
std::vector<std::uint16_t> packed(const std::vector<float>& votes_m, double unit) {
  std::vector<std::uint16_t> values(votes_m.size());
  std::transform(votes_m.begin(), votes_m.end(), values.begin(), [unit](float votes) {
    return static_cast<std::uint16_t>(std::min(65535.0, std::round(static_cast<double>(votes) / unit)));
  });
  return values;
}

}  // namespace

bool write_hough(const std::filesystem::path& path, const DetectLinesResult& result,
                 const Provenance& provenance) {
  H5Writer file(path, artefacts::kHough, provenance, result.lines.frame);
  const HoughPicture& hough = result.hough;
  const float highest =
      hough.votes_m.empty() ? 0.0F : *std::max_element(hough.votes_m.begin(), hough.votes_m.end());
  const double unit = std::max(kVoteUnit, static_cast<double>(highest) / 65535);
  const std::vector<std::uint16_t> votes = packed(hough.votes_m, unit);
  file.write("accumulator/votes", std::span<const std::uint16_t>(votes), {hough.angles, hough.distances}, "1",
             "votes in units of accumulator/vote_unit; rows: angle, columns: distance");
  file.write("accumulator/vote_unit", std::vector<double>{unit}, "m", "length of wall per vote");
  file.write("accumulator/angle_step", std::vector<double>{hough.angle_step}, "rad",
             "row a: theta in [a, a+1) steps");
  file.write("accumulator/distance_step", std::vector<double>{hough.distance_step}, "m", "width of a column");
  file.write("accumulator/distance0", std::vector<double>{hough.distance0}, "m",
             "lower edge of column 0, from the centre");
  file.write("accumulator/centre", std::vector<double>{hough.centre.x(), hough.centre.y()}, "m",
             "where distances are measured from");
  const WallCells& cells = result.cells;
  file.write("cells/x", cells.x, "m", "centroid");
  file.write("cells/y", cells.y, "m", "centroid");
  file.write("cells/slice", std::vector<std::uint16_t>(cells.slice.begin(), cells.slice.end()), "1",
             "wall slice");
  file.write("cells/boundary", cells.boundary, "1", "1 = piece of a wall, 0 = clutter");
  file.write("cells/theta", cells.theta, "rad", "direction of the wall's normal; 0 for clutter");
  file.write("cells/line", cells.line, "1",
             "index of the detected line (w0001 = 0) that took the cell; -1 = none");
  return file.commit();
}

}  // namespace roomcut::detect_lines

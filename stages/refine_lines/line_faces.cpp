// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/line_faces.h"

#include <algorithm>
#include <cmath>

namespace roomcut::refine_lines {

namespace {

constexpr double kCovered = 0.9;  ///< share of a bin that must be surface
constexpr double kFewestBins = 10;
constexpr double kShortestBin_m = 0.02;

struct Piece {
  std::size_t layer;
  double t0, t1;
  bool towards_normal;  ///< the empty side, or the emptier one
};

std::vector<std::vector<Piece>> find_pieces(const CellComplex& complex,
                                            const std::vector<std::uint8_t>& label,
                                            const CarriedRuns& carried) {
  std::vector<std::vector<Piece>> pieces(complex.lines.size());
  for (const CellComplex::Edge& edge : complex.edges) {
    if (!complex.on_wall_line(edge)) {
      continue;
    }
    const Line2& line = complex.lines[static_cast<std::size_t>(edge.line)].line;
    const double from = line.along(complex.vertices[static_cast<std::size_t>(edge.v0)]);
    const double to = line.along(complex.vertices[static_cast<std::size_t>(edge.v1)]);
    for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
      if (!carried.empty() && !carried[static_cast<std::size_t>(edge.line)].holds(layer, 0.5 * (from + to))) {
        continue;
      }
      const int left = emptiness(complex, label, edge.left, layer);
      const int right = emptiness(complex, label, edge.right, layer);
      if (left != right) {
        // The normal is the direction turned by -90 degrees: it points to the right of an edge that runs
        // along it.
        pieces[static_cast<std::size_t>(edge.line)].push_back(
            {layer, std::min(from, to), std::max(from, to), (left > right) != (to > from)});
      }
    }
  }
  return pieces;
}

void raster(const std::vector<Piece>& pieces, LineFaces& faces) {
  std::vector<double> covered[2];  // by faces whose empty side is away from, towards the normal [m]
  covered[0].assign(faces.bins * faces.layers, 0);
  covered[1].assign(faces.bins * faces.layers, 0);
  for (const Piece& piece : pieces) {
    const auto first =
        static_cast<std::size_t>(std::max(0.0, std::floor((piece.t0 - faces.t0) / faces.bin_m)));
    for (std::size_t bin = first; bin < faces.bins; ++bin) {
      const double low = faces.t0 + static_cast<double>(bin) * faces.bin_m;
      const double overlap = std::min(piece.t1, low + faces.bin_m) - std::max(piece.t0, low);
      if (overlap <= 0 && low > piece.t1) {
        break;
      }
      covered[piece.towards_normal ? 1 : 0][bin * faces.layers + piece.layer] += std::max(0.0, overlap);
    }
  }
  for (std::size_t i = 0; i < faces.side.size(); ++i) {
    const double most = std::max(covered[0][i], covered[1][i]);
    if (most >= kCovered * faces.bin_m) {
      faces.side[i] = covered[1][i] >= covered[0][i] ? 1 : -1;
    }
  }
}

}  // namespace

LineFaces slice_bins(const LineFaces& faces, std::size_t first, std::size_t end,
                     const std::vector<double>& layer_height) {
  LineFaces slice = faces;
  slice.bins = end - first;
  slice.t0 = faces.t0 + static_cast<double>(first) * faces.bin_m;
  slice.t1 = faces.t0 + static_cast<double>(end) * faces.bin_m;
  slice.side.assign(faces.side.begin() + static_cast<std::ptrdiff_t>(first * faces.layers),
                    faces.side.begin() + static_cast<std::ptrdiff_t>(end * faces.layers));
  slice.area_m2 = 0;
  for (std::size_t i = 0; i < slice.side.size(); ++i) {
    slice.area_m2 += slice.side[i] != 0 ? faces.bin_m * layer_height[i % faces.layers] : 0;
  }
  return slice;
}

std::vector<LineFaces> find_line_faces(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                                       double bin_m, const CarriedRuns& carried) {
  const std::vector<std::vector<Piece>> pieces = find_pieces(complex, label, carried);
  std::vector<LineFaces> result(complex.lines.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    LineFaces& faces = result[i];
    faces.line = complex.lines[i].line;
    faces.layers = complex.layers();
    if (pieces[i].empty()) {
      continue;
    }
    faces.t0 = pieces[i].front().t0;
    faces.t1 = pieces[i].front().t1;
    for (const Piece& piece : pieces[i]) {
      faces.t0 = std::min(faces.t0, piece.t0);
      faces.t1 = std::max(faces.t1, piece.t1);
      faces.area_m2 += (piece.t1 - piece.t0) * complex.height(piece.layer);
    }
    const double hull = faces.t1 - faces.t0;
    const double step = std::clamp(hull / kFewestBins, std::min(kShortestBin_m, bin_m), bin_m);
    faces.bins = static_cast<std::size_t>(std::max(1.0, std::round(hull / step)));
    faces.bin_m = hull / static_cast<double>(faces.bins);
    faces.side.assign(faces.bins * faces.layers, 0);
    raster(pieces[i], faces);
  }
  return result;
}

}  // namespace roomcut::refine_lines

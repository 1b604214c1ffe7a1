// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/level_surfaces.h"
#include "common/mesh/triangle_mesh.h"
#include "common/openings/opening.h"
#include "common/picture/image.h"
#include "common/slices/slices.h"
#include "common/sloped_planes/accepted_planes.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut::report {

/// One picture of a report: an SVG document or the bytes of a PNG file.
struct Picture {
  std::string stage;    ///< the stage whose result it shows
  std::string file;     ///< "slice_histogram.svg"
  std::string title;    ///< one line
  std::string caption;  ///< what the colours mean
  std::string bytes;
};

/// The vertical histogram with its peaks, their bands and the wall slices between (paper, Figure 1).
Picture draw_histogram(const Slices& slices);

/// The occupancy grid of one wall slice and the wall lines over it (paper, Figure 2): cells from light
/// (covered over a small part of the height) to dark; lines with their support, numbered by wall id in the
/// tooltip.
Picture draw_occupancy(const Slices& slices, std::size_t slice, const std::vector<WallLine>& lines);

/// What a hand edit did to the lines.
Picture draw_acceptance(const std::vector<WallLine>& detected, const std::vector<WallLine>& accepted);
/// The outlines of sloped planes over the wall lines, an arrow uphill in each.
Picture draw_planes(const AcceptedPlanes& planes, const std::vector<WallLine>& lines);
/// Where the lines went: lines before refinement in orange, after it in blue.
Picture draw_refinement(const std::vector<WallLine>& before, const std::vector<WallLine>& after);

// `stage` is the name of the run: that of the stage, or "final_…" for the second pass.

/// The faces of the plan and the lines that cut it (paper, Figure 3).
Picture draw_partition(const std::string& stage, const CellComplex& complex);
/// How much of each wall face of a layer points cover.
Picture draw_weights(const std::string& stage, const CellComplex& complex, const FaceWeights& weights,
                     std::size_t layer);
/// What the evidence says of each cell of a layer; tooltips give the parts.
Picture draw_evidence(const std::string& stage, const CellComplex& complex, const DataTerms& terms,
                      std::size_t layer);
/// The cells of one layer with their labels: empty cells blue, solid ones grey, the darker the larger the
/// margin of the decision; unobserved ones pink. Tooltips give every evidence of the cell.
Picture draw_cells(const std::string& stage, const CellComplex& complex, const DataTerms& terms,
                   const Labels& labels, std::size_t layer);
/// Rooms, walls and the openings that reach into a layer.
Picture draw_openings(const std::string& stage, const CellComplex& complex, const Labels& labels,
                      const std::vector<Opening>& openings, std::size_t layer);

/// How far floors and ceilings lie from one level; tooltips give height, sigma and tilt.
Picture draw_surfaces(const std::string& stage, const CellComplex& complex, const LevelSurfaces& surfaces,
                      std::size_t level);

/// The model seen from above at a slant, walls and ceilings between the eye and the rooms left out (paper,
/// Figure 5).
Picture draw_model(const TriangleMesh& model, int width_px);
/// One storey of it, straight from above.
Picture draw_storey(const TriangleMesh& model, int storey, int width_px);

/// Points coloured by height, from the same eye as draw_model().
Picture draw_cloud(const std::vector<Vec3>& points, int width_px);

/// An SVG document of any picture, its title and caption above it.
std::string captioned(const Picture& picture);

}  // namespace roomcut::report

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/geometry/scan_coordinates.h"
#include "common/picture/svg.h"
#include "stages/tools/compare/run_facts.h"

namespace roomcut::compare {

/// One storey of one run, its plan brought into the frame of the drawing. The run must outlive it.
struct StoreyLayer {
  const RunFacts& run;
  std::size_t layer;
  ScanCoordinates own, drawing;  ///< of the run's frame and of the drawing's
  double low, high;              ///< heights, local [m]

  std::size_t faces() const { return run.plan->complex.faces(); }
  /// A place of the run in the drawing.
  Vec2 placed(const Vec2& local) const { return drawing.plan_to_local(own.plan_to_scan(local)); }
  std::vector<Vec2> corners(std::size_t face) const;
  bool empty(std::int32_t face) const;  ///< false for -1, beyond the bounding box
  bool unknown(std::size_t face) const;
  bool unobserved(std::size_t face) const;
};

/// The layer of cells 1.2 m above a storey's floor; empty without storey or cells there.
std::optional<StoreyLayer> layer_of(const RunFacts& run, const SpaceFacts* storey, const Frame& frame);

/// The border between empty and solid.
void draw_walls(Svg& svg, const StoreyLayer& layer, double width_px);
/// The openings that reach into the layer.
void draw_openings(Svg& svg, const StoreyLayer& layer);
/// The empty cells, without those places that `other` calls empty too. `mask` is an id that is unique on the
/// page.
void draw_only(Svg& svg, const StoreyLayer& layer, const std::optional<StoreyLayer>& other, Colour colour,
               const std::string& mask);

}  // namespace roomcut::compare

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/compare/storey_layer.h"

#include <algorithm>

#include "common/picture/colour_map.h"

namespace roomcut::compare {

namespace {

constexpr double kCut_m = 1.2;  // above the floor
constexpr Colour kWall{20, 20, 20}, kOpening{0, 158, 115};

}  // namespace

std::vector<Vec2> StoreyLayer::corners(std::size_t face) const {
  std::vector<Vec2> out;
  for (const Vec2& corner : run.plan->complex.corners(face)) {
    out.emplace_back(placed(corner));
  }
  return out;
}

bool StoreyLayer::empty(std::int32_t face) const {
  return is_empty(run.plan->complex, run.plan->labels.label, face, layer);
}

bool StoreyLayer::unknown(std::size_t face) const {
  return is_unknown(run.plan->labels.label, run.plan->complex.cell(face, layer));
}

bool StoreyLayer::unobserved(std::size_t face) const {
  return run.plan->labels.unobserved[run.plan->complex.cell(face, layer)] != 0;
}

std::optional<StoreyLayer> layer_of(const RunFacts& run, const SpaceFacts* storey, const Frame& frame) {
  if (storey == nullptr || !run.plan) {
    return std::nullopt;
  }
  const auto& levels = run.plan->complex.levels;
  const ScanCoordinates own(run.frame);
  const double z = own.to_local(Vec3(storey->centre.x(), storey->centre.y(), storey->floor_z)).z() + kCut_m;
  const std::int32_t at = run.plan->complex.layer_at(z);
  if (at < 0) {
    return std::nullopt;
  }
  const auto layer = static_cast<std::size_t>(at);
  return StoreyLayer{run, layer, own, ScanCoordinates(frame), levels[layer], levels[layer + 1]};
}

void draw_walls(Svg& svg, const StoreyLayer& layer, double width_px) {
  const CellComplex& complex = layer.run.plan->complex;
  for (const CellComplex::Edge& edge : complex.edges) {
    if (layer.empty(edge.left) != layer.empty(edge.right)) {
      svg.line(layer.placed(complex.vertices[edge.v0]), layer.placed(complex.vertices[edge.v1]), kWall,
               width_px);
    }
  }
}

void draw_openings(Svg& svg, const StoreyLayer& layer) {
  for (const Opening& opening : layer.run.openings) {
    if (opening.sill_z < layer.high && opening.head_z > layer.low) {
      const Vec2 along = (opening.jamb_b - opening.jamb_a).normalized();
      const Vec2 across = 0.5 * opening.thickness_m * Vec2(-along.y(), along.x());
      std::vector<Vec2> corners = {opening.jamb_a + across, opening.jamb_b + across, opening.jamb_b - across,
                                   opening.jamb_a - across};
      for (Vec2& corner : corners) {
        corner = layer.placed(corner);
      }
      svg.polygon(corners, kOpening, 1, opening.id);
    }
  }
}

/// The empty cells of a layer, without those places that the other one calls empty too.
void draw_only(Svg& svg, const StoreyLayer& layer, const std::optional<StoreyLayer>& other, Colour colour,
               const std::string& mask) {
  if (other) {
    svg.open("mask", "id=\"" + mask + "\"");
    svg.open("rect", "width=\"100%\" height=\"100%\" fill=\"#ffffff\"");
    svg.close("rect");
    // A stroke closes the seams between neighbouring cells.
    svg.open("g", "stroke=\"#000000\" stroke-width=\"0.8\"");
    for (std::size_t f = 0; f < other->faces(); ++f) {
      if (other->empty(static_cast<std::int32_t>(f))) {
        svg.polygon(other->corners(f), {0, 0, 0}, 1);
      }
    }
    svg.close("g");
    svg.close("mask");
  }
  svg.open("g", "stroke=\"" + hex(colour) + "\" stroke-width=\"0.5\"" +
                    (other ? " mask=\"url(#" + mask + ")\"" : ""));
  for (std::size_t f = 0; f < layer.faces(); ++f) {
    if (layer.empty(static_cast<std::int32_t>(f))) {
      svg.polygon(layer.corners(f), colour, 1);
    }
  }
  svg.close("g");
}

}  // namespace roomcut::compare

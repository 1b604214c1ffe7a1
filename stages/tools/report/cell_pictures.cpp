// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/picture/colour_map.h"
#include "stages/tools/report/pictures.h"
#include "stages/tools/report/plan_picture.h"

namespace roomcut::report {

namespace {

constexpr Colour kUnobserved{228, 180, 206}, kUnknown{240, 228, 66}, kSolid{225, 225, 225},
    kRoom{245, 245, 245}, kCrease{170, 120, 60};

std::string cell_title(const DataTerms& terms, const Labels* labels, std::size_t cell) {
  char text[200];
  std::snprintf(text, sizeof text,
                "cell %zu: probability of empty %.2f; odd rays %.2f, above and below %+.2f, around %+.2f, "
                "observed %.2f",
                cell, terms.beta[cell], terms.kappa[cell], terms.vertical[cell], terms.around[cell],
                terms.observed[cell]);
  std::string title = text;
  if (labels != nullptr) {
    std::snprintf(text, sizeof text, "; %s%s, flipping it would cost %.2f m³",
                  is_empty(labels->label, cell)     ? "empty"
                  : is_unknown(labels->label, cell) ? "unknown"
                                                    : "solid",
                  labels->unobserved[cell] != 0 ? " (unobserved)" : "", labels->margin_m3[cell]);
    title += text;
  }
  return title;
}

std::string name_of(const std::string& stage, std::size_t layer) {
  return stage + "_" + std::to_string(layer) + ".svg";
}

}  // namespace

Picture draw_partition(const std::string& stage, const CellComplex& complex) {
  Svg svg = plan_of(complex);
  draw_edges(svg, complex, nullptr, 0);
  for (std::size_t i = 0; i < complex.lines.size(); ++i) {
    const CellComplex::Line& line = complex.lines[i];
    const bool wall = line.plane < 0;
    svg.line(line.line.at(line.t0), line.line.at(line.t1),
             wall ? categorical_colour(static_cast<int>(i)) : kCrease, wall ? 2 : 1, line.wall_id);
  }
  return {stage, stage + ".svg", "The plan cut into " + std::to_string(complex.faces()) + " convex faces",
          "Grey: edges of the faces, the same in every layer. Coloured: the wall lines where points carry "
          "them. Brown, "
          "thin: creases of sloped planes.",
          svg.str()};
}

Picture draw_weights(const std::string& stage, const CellComplex& complex, const FaceWeights& weights,
                     std::size_t layer) {
  Svg svg = plan_of(complex);
  fill_cells(svg, complex, layer, [&](std::size_t cell) {
    return CellLook{kRoom, "cell " + std::to_string(cell) + ": " + std::to_string(weights.cell_points[cell]) +
                               " points inside"};
  });
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const std::size_t face = complex.wall_face(e, layer);
    const double omega = weights.wall_omega[face];
    char text[120];
    std::snprintf(text, sizeof text, "covered over %.0f %%, %u points", 100 * omega,
                  weights.wall_points[face]);
    svg.line(complex.vertices[complex.edges[e].v0], complex.vertices[complex.edges[e].v1],
             sequential_colour(1 - omega), 0.5 + 3 * omega, text);
  }
  return {stage, name_of(stage, layer), "Coverage of the wall faces, " + heights_of(complex, layer),
          "The thicker and darker a face, the more of it points cover.", svg.str()};
}

Picture draw_evidence(const std::string& stage, const CellComplex& complex, const DataTerms& terms,
                      std::size_t layer) {
  Svg svg = plan_of(complex);
  fill_cells(svg, complex, layer, [&](std::size_t cell) {
    return CellLook{diverging_colour(1 - 2 * static_cast<double>(terms.beta[cell])),
                    cell_title(terms, nullptr, cell)};
  });
  draw_edges(svg, complex, nullptr, layer);
  return {stage, name_of(stage, layer), "Evidence of the cells, " + heights_of(complex, layer),
          "Blue: the evidence speaks for empty. Orange: for solid. White: undecided.", svg.str()};
}

Picture draw_cells(const std::string& stage, const CellComplex& complex, const DataTerms& terms,
                   const Labels& labels, std::size_t layer) {
  Svg svg = plan_of(complex);
  fill_cells(svg, complex, layer, [&](std::size_t cell) {
    // The margin per volume says how sure the decision is, whatever the cell's size.
    const double volume = complex.volume(cell);
    const double sure = std::clamp(labels.margin_m3[cell] / std::max(volume, 1e-9), 0.0, 1.0);
    const bool empty = is_empty(labels.label, cell);
    const Colour fill = is_unknown(labels.label, cell) ? kUnknown
                        : !empty                       ? kSolid
                        : labels.unobserved[cell] != 0 ? kUnobserved
                                                       : diverging_colour(-0.25 - 0.6 * sure);
    return CellLook{fill, cell_title(terms, &labels, cell)};
  });
  draw_edges(svg, complex, &labels, layer);
  return {stage, name_of(stage, layer), "Labels of the cells, " + heights_of(complex, layer),
          "Blue: empty, darker where the decision is surer. Grey: solid or outside. Pink: empty but hardly "
          "observed. Yellow: unknown, a room or open air. Black: walls.",
          svg.str()};
}

Picture draw_openings(const std::string& stage, const CellComplex& complex, const Labels& labels,
                      const std::vector<Opening>& openings, std::size_t layer) {
  Svg svg = plan_of(complex);
  fill_cells(svg, complex, layer, [&](std::size_t cell) {
    return CellLook{is_empty(labels.label, cell) ? diverging_colour(-0.25) : kSolid, ""};
  });
  draw_edges(svg, complex, &labels, layer);
  for (const Opening& opening : openings) {
    if (opening.sill_z >= complex.levels[layer + 1] || opening.head_z <= complex.levels[layer]) {
      continue;
    }
    const Vec2 along = (opening.jamb_b - opening.jamb_a).normalized();
    const Vec2 across = 0.5 * opening.thickness_m * Vec2(-along.y(), along.x());
    const std::vector<Vec2> corners = {opening.jamb_a + across, opening.jamb_b + across,
                                       opening.jamb_b - across, opening.jamb_a - across};
    char text[120];
    std::snprintf(text, sizeof text, "%s: %.2f m wide, %.2f m high", opening.id.c_str(), opening.width(),
                  opening.height());
    svg.polygon(corners, categorical_colour(2), 1, text);
    svg.text(opening.jamb_b + 0.1 * along, opening.id, 11, {20, 20, 20});
  }
  return {stage, name_of(stage, layer), "Openings, " + heights_of(complex, layer),
          "Blue: rooms. Black: walls. Green: openings, proven by points on jambs and head.", svg.str()};
}

Picture draw_surfaces(const std::string& stage, const CellComplex& complex, const LevelSurfaces& surfaces,
                      std::size_t level) {
  constexpr double kFull_m = 0.02;
  Svg svg = plan_of(complex);
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const std::int32_t index = surfaces.of_face[complex.level_face(f, level)];
    const FaceCorners corners = complex.corners(f);
    Colour fill = kSolid;
    char text[200] = "";
    if (index >= 0) {
      const LevelSurface& surface = surfaces.surfaces[static_cast<std::size_t>(index)];
      const Vec2 middle = complex.centroid(f);
      const double shift = surface.height(middle) - complex.levels[level];
      fill = diverging_colour(std::clamp(shift / kFull_m, -1.0, 1.0));
      std::snprintf(text, sizeof text,
                    "%.4f m, %+.1f mm from its level; sigma %.1f mm, falls by %.2f %%, %lld points",
                    surface.height(middle) + complex.frame.origin[2], 1e3 * shift, 1e3 * surface.sigma_m,
                    100 * surface.gradient.norm(), static_cast<long long>(surface.points));
    }
    svg.polygon(std::vector<Vec2>(corners.begin(), corners.end()), fill, 1, text);
  }
  char title[100];
  std::snprintf(title, sizeof title, "Floors and ceilings of the level at %.2f m",
                complex.levels[level] + complex.frame.origin[2]);
  return {
      stage, name_of(stage, level), title,
      "Orange: higher than the level, up to 2 cm. Blue: lower. White: at it. Grey: no floor or ceiling, or "
      "too little of it seen.",
      svg.str()};
}

}  // namespace roomcut::report

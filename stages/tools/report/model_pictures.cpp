// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "common/picture/colour_map.h"
#include "common/picture/render.h"
#include "stages/tools/report/pictures.h"

namespace roomcut::report {

namespace {

constexpr std::size_t kHeightColours = 255;  // with the background as many as a palette holds

Colour surface_colour(std::uint8_t kind) {
  switch (static_cast<SurfaceKind>(kind)) {
    case SurfaceKind::kFloor:
      return {222, 203, 164};
    case SurfaceKind::kCeiling:
      return {176, 196, 222};
    default:
      return {205, 214, 218};
  }
}

/// The triangles of one storey, or of all for -1.
Drawing drawing_of(const TriangleMesh& model, int storey) {
  Drawing drawing;
  drawing.vertices = model.vertices;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    if (storey >= 0 && !model.storey.empty() && model.storey[t] != storey) {
      continue;
    }
    drawing.triangles.push_back(model.triangles[t]);
    drawing.triangle_colours.push_back(surface_colour(model.kind.empty() ? 2 : model.kind[t]));
  }
  return drawing;
}

std::string png(const Drawing& drawing, const View& view) {
  const auto bytes = encode_png(render(drawing, view));
  return {bytes.begin(), bytes.end()};
}

View slanted(int width_px) {
  View view;
  view.azimuth = -0.35 * std::numbers::pi;
  view.elevation = 0.27 * std::numbers::pi;
  view.width = width_px;
  view.height = width_px * 3 / 4;
  return view;
}

}  // namespace

Picture draw_model(const TriangleMesh& model, int width_px) {
  return {"extract", "model.png", "The model",
          "Seen from outside into the rooms: what faces the eye is left out. Floors sand, ceilings blue, "
          "walls grey.",
          png(drawing_of(model, -1), slanted(width_px))};
}

Picture draw_storey(const TriangleMesh& model, int storey, int width_px) {
  View view = slanted(width_px);
  view.azimuth = -std::numbers::pi / 2;
  view.elevation = 0.46 * std::numbers::pi;  // nearly straight down: walls keep a visible inner side
  return {"extract", "storey_" + std::to_string(storey) + ".png", "Storey " + std::to_string(storey),
          "From above, ceilings left out.", png(drawing_of(model, storey), view)};
}

Picture draw_cloud(const std::vector<Vec3>& points, int width_px) {
  Drawing drawing;
  drawing.points = points;
  double low = 1e30, high = -1e30;
  for (const Vec3& p : points) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  std::array<Colour, kHeightColours> colours{};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    colours[i] = sequential_colour(static_cast<double>(i) / (kHeightColours - 1));
  }
  const double per_m = (kHeightColours - 1) / std::max(high - low, 1e-9);
  drawing.point_colours.reserve(points.size());
  for (const Vec3& p : points) {
    drawing.point_colours.push_back(colours[static_cast<std::size_t>(std::lround((p.z() - low) * per_m))]);
  }
  View view = slanted(width_px);
  view.smooth = false;
  return {"ingest", "cloud.png", "The scan", "Points from low (dark) to high (yellow).", png(drawing, view)};
}

}  // namespace roomcut::report

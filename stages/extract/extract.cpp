// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/extract.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/errors/codes.h"
#include "stages/extract/cell_surface.h"

namespace roomcut {

namespace {

SurfaceAreas measure_areas(const TriangleMesh& mesh) {
  SurfaceAreas areas;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto kind = static_cast<SurfaceKind>(mesh.kind[t]);
    double& sum = kind == SurfaceKind::kFloor     ? areas.floor
                  : kind == SurfaceKind::kCeiling ? areas.ceiling
                                                  : areas.wall;
    sum += triangle_area(mesh, t);
  }
  return areas;
}

std::string volume_fault(double mesh_m3, double cells_m3) {
  // The vertices of one wall lie within kPlanSnap_m of its line, not on it, so that a wall triangulated as a
  // whole encloses a little more or less than its cells: up to 1.5e-8 on random buildings. A lost cell is far
  // more.
  constexpr double kRelative = 1e-6;
  if (std::abs(mesh_m3 - cells_m3) <= kRelative * cells_m3) {
    return "";
  }
  std::array<char, 120> text;
  std::snprintf(text.data(), text.size(), "its volume is %.9f m3, but the empty cells have %.9f m3", mesh_m3,
                cells_m3);
  return text.data();
}

void measure_unobserved(const CellComplex& complex, const Labels& labels, Model& model) {
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    const double area = complex.area(face);
    for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
      const std::size_t cell = complex.cell(face, layer);
      if (labels.unobserved[cell] != 0) {
        const bool empty = labels.label[cell] == static_cast<std::uint8_t>(Label::kEmpty);
        (empty ? model.unobserved_empty_m3 : model.unobserved_solid_m3) += area * complex.height(layer);
      }
    }
  }
}

}  // namespace

Model extract_model(const CellComplex& complex, const Labels& labels, const ExtractParams& params) {
  Model model;
  model.empty_m3 = empty_volume(complex, labels.label);
  if (!(model.empty_m3 > 0)) {
    throw StageError(errors::kEmptyModel, "", "every cell is solid: there is no room to model",
                     "look at the labels' evidence; a smaller graphcut.mu_m lets smaller spaces survive");
  }
  const Storeys storeys = find_storeys(complex, labels.label, params.storeys);
  model.surface = merge_facets(surface_of_labels(complex, labels.label, storeys));
  model.storeys = measure_storeys(complex, labels, storeys);
  model.rooms = find_rooms(complex, labels, storeys);
  model.areas = measure_areas(model.surface.mesh);
  measure_unobserved(complex, labels, model);
  model.check = check_mesh(model.surface.mesh);
  model.fault = model.surface.fault;
  for (const std::string& more :
       {describe_faults(model.check), volume_fault(model.check.volume_m3, model.empty_m3)}) {
    if (!more.empty()) {
      model.fault += (model.fault.empty() ? "" : "; ") + more;
    }
  }
  return model;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/report/report_io.h"

#include <set>

#include "common/cells/cells_io.h"
#include "common/mesh/mesh_io.h"
#include "common/slices/slices_io.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

namespace {

std::vector<WallLine> lines_of(const StageRun& run, const std::string& input) {
  return run.has_input(input) ? read_wall_lines(run.input(input)).content.lines : std::vector<WallLine>{};
}

void draw_slices(const StageRun& run, bool histogram, bool occupancy, std::vector<Picture>& pictures) {
  const Slices slices = read_slices(run.input("slices"));
  if (histogram) {
    pictures.push_back(draw_histogram(slices));
  }
  const auto lines = lines_of(run, "lines");
  for (std::size_t k = 0; occupancy && k < slices.wall_slices.size(); ++k) {
    if (slices.wall_slices[k].size() > 0) {
      pictures.push_back(draw_occupancy(slices, k, lines));
    }
  }
}

void draw_layers(const StageRun& run, std::vector<Picture>& pictures) {
  const CellsFile cells = read_cells(run.input("cells"));
  const DataTerms terms = read_data_terms(run.input("terms"), cells);
  const Labels labels = read_labels(run.input("labels"), cells);
  for (std::size_t k = 0; k < cells.complex.layers(); ++k) {
    bool any = false;
    for (std::size_t f = 0; f < cells.complex.faces(); ++f) {
      any = any || labels.label[cells.complex.cell(f, k)] != 0;
    }
    if (any && cells.complex.height(k) > 0.5) {  // thin layers between close levels show nothing new
      pictures.push_back(draw_cells(cells.complex, terms, labels, k));
    }
  }
}

void draw_models(const StageRun& run, int width_px, std::vector<Picture>& pictures) {
  const TriangleMesh model = read_mesh(run.input("model"));
  pictures.push_back(draw_model(model, width_px));
  for (const std::int16_t storey : std::set<std::int16_t>(model.storey.begin(), model.storey.end())) {
    pictures.push_back(draw_storey(model, storey, width_px));
  }
}

}  // namespace

std::vector<StageFile> report_inputs() {
  return {{"cloud", "10_ingest/cloud.h5", "the cloud", true},
          {"slices", "20_slice/slices.h5", "the slices", true},
          {"detected", "30_detect_lines/wall_lines.geojson", "the detected wall lines", true},
          {"hough", "30_detect_lines/hough.h5", "what the detection saw", true},
          {"lines", "40_accept_lines/wall_lines.geojson", "the accepted wall lines", true},
          {"refined", "80_refine_lines/wall_lines.geojson", "the refined wall lines", true},
          {"first_cells", "50_partition/cells.h5", "the cells of the first pass", true},
          {"first_weights", "55_weigh_faces/weights.h5", "the weights of their faces", true},
          {"first_terms", "60_raycast/data_terms.h5", "their data terms", true},
          {"first_labels", "70_graphcut/labels.h5", "their labels", true},
          {"cells", "90_final/cells.h5", "the cells", true},
          {"weights", "90_final/weights.h5", "the weights of their faces", true},
          {"terms", "90_final/data_terms.h5", "their data terms", true},
          {"labels", "90_final/labels.h5", "their labels", true},
          {"model", "model.ply", "the model", true},
          {"summary", "summary.json", "its summary", true}};
}

std::vector<Picture> draw_pictures(const StageRun& run, const ReportParams& params, const std::string& only,
                                   const std::vector<ThinPoint>& points) {
  const auto wanted = [&](const char* stage) { return only == "all" || only == stage; };
  std::vector<Picture> pictures;
  if (wanted("extract") && run.has_input("model")) {
    draw_models(run, params.picture_px, pictures);
  }
  if (wanted("ingest") && run.has_input("cloud")) {
    std::vector<Vec3> places;
    places.reserve(points.size());
    for (const ThinPoint& point : points) {
      places.push_back(point.at);
    }
    pictures.push_back(draw_cloud(places, params.picture_px));
  }
  if ((wanted("slice") || wanted("detect_lines")) && run.has_input("slices")) {
    draw_slices(run, wanted("slice"), wanted("detect_lines"), pictures);
  }
  if (wanted("graphcut") && run.has_input("cells") && run.has_input("terms") && run.has_input("labels")) {
    draw_layers(run, pictures);
  }
  if (wanted("refine_lines") && run.has_input("lines") && run.has_input("refined")) {
    pictures.push_back(draw_refinement(lines_of(run, "lines"), lines_of(run, "refined")));
  }
  return pictures;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/report/report_io.h"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "common/artefact/local_crs.h"
#include "common/cells/cells_io.h"
#include "common/mesh/mesh_io.h"
#include "common/openings/openings_io.h"
#include "common/slices/slices_io.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/report/occupancy_raster.h"
#include "stages/report/pass_pictures.h"

namespace roomcut {

namespace {

using Pictures = std::vector<Picture>;
using Draw = std::function<void(const StageRun&, const ReportParams&, Pictures&)>;

std::vector<WallLine> lines_of(const StageRun& run, const std::string& input) {
  return read_wall_lines(run.input(input)).content.lines;
}

Draw draw_scan(const std::vector<ThinPoint>& points) {
  return [&points](const StageRun& /*run*/, const ReportParams& params, Pictures& pictures) {
    std::vector<Vec3> places;
    places.reserve(points.size());
    for (const ThinPoint& point : points) {
      places.push_back(point.at);
    }
    pictures.push_back(draw_cloud(places, params.picture_px));
  };
}

void draw_levels(const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
  pictures.push_back(draw_histogram(read_slices(run.input("slices"))));
}

void draw_detection(const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
  const Slices slices = read_slices(run.input("slices"));
  const auto lines = lines_of(run, "detected");
  for (std::size_t k = 0; k < slices.wall_slices.size(); ++k) {
    if (slices.wall_slices[k].size() > 0) {
      pictures.push_back(draw_occupancy(slices, k, lines));
    }
  }
}

void draw_accepted(const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
  pictures.push_back(draw_acceptance(lines_of(run, "detected"), lines_of(run, "lines")));
}

void draw_refined(const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
  pictures.push_back(draw_refinement(lines_of(run, "lines"), lines_of(run, "refined")));
}

void draw_model_views(const StageRun& run, const ReportParams& params, Pictures& pictures) {
  const TriangleMesh model = read_mesh(run.input("model"));
  pictures.push_back(draw_model(model, params.picture_px));
  for (const std::int16_t storey : std::set<std::int16_t>(model.storey.begin(), model.storey.end())) {
    pictures.push_back(draw_storey(model, storey, params.picture_px));
  }
}

/// How the result of one run of the pipeline is drawn.
struct StageDrawing {
  std::string stage;
  std::vector<std::string> needs;  ///< inputs without which there is nothing to draw
  bool overview;                   ///< whether `make run` draws it
  Draw draw;
};

/// The stages that work on cells: of the first pass, or of the second.
void add_pass(const std::string& prefix, const PassInputs& inputs, bool overview,
              std::vector<StageDrawing>& list) {
  const auto add = [&](const char* name, std::vector<std::string> needs, bool is_overview, auto draw) {
    const std::string stage = prefix + name;
    list.push_back({stage, std::move(needs), is_overview,
                    [=](const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
                      draw(run, inputs, stage, pictures);
                    }});
  };
  add("partition", {inputs.cells}, false, draw_partition_of);
  add("weigh_faces", {inputs.cells, inputs.weights}, false, draw_weights_of);
  add("raycast", {inputs.cells, inputs.terms}, false, draw_evidence_of);
  add("graphcut", {inputs.cells, inputs.terms, inputs.labels}, overview, draw_labels_of);
}

std::vector<StageDrawing> stage_drawings(const std::vector<ThinPoint>& points) {
  const PassInputs first{"first_cells", "first_weights", "first_terms", "first_labels"};
  const PassInputs second{"cells", "weights", "terms", "labels"};
  std::vector<StageDrawing> list = {{"ingest", {"cloud"}, true, draw_scan(points)},
                                    {"slice", {"slices"}, true, draw_levels},
                                    {"detect_lines", {"slices", "detected"}, true, draw_detection},
                                    {"accept_lines", {"detected", "lines"}, false, draw_accepted}};
  add_pass("", first, false, list);
  list.push_back({"refine_lines", {"lines", "refined"}, true, draw_refined});
  add_pass("final_", second, true, list);
  list.push_back({"find_openings",
                  {"cells", "labels", "openings"},
                  false,
                  [second](const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
                    draw_openings_of(run, second, pictures);
                  }});
  list.push_back({"extract", {"model"}, true, draw_model_views});
  return list;
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
          {"openings", "95_find_openings/openings.geojson", "the openings", true},
          {"model", "model.ply", "the model", true},
          {"summary", "summary.json", "its summary", true}};
}

std::vector<std::string> report_choices() {
  std::vector<std::string> choices = {"all", "pictures", "layers"};
  for (const StageDrawing& drawing : stage_drawings({})) {
    choices.push_back(drawing.stage);
  }
  return choices;
}

std::vector<Picture> draw_pictures(const StageRun& run, const ReportParams& params, const std::string& only,
                                   const std::vector<ThinPoint>& points) {
  const bool overview = only == "all" || only == "pictures";
  Pictures pictures;
  for (const StageDrawing& drawing : stage_drawings(points)) {
    const bool wanted = overview ? drawing.overview : drawing.stage == only;
    if (wanted && std::all_of(drawing.needs.begin(), drawing.needs.end(),
                              [&](const std::string& input) { return run.has_input(input); })) {
      drawing.draw(run, params, pictures);
    }
  }
  return pictures;
}

std::vector<Picture> draw_layers(const StageRun& run) {
  Pictures files;
  const Slices slices = read_slices(run.input("slices"));
  for (std::size_t k = 0; k < slices.wall_slices.size(); ++k) {
    const GridRaster raster = occupancy_raster(slices, k);
    const std::string name = "slice_" + std::to_string(k);
    const auto png = encode_png(raster.image);
    files.push_back({"slice", name + ".pgw", "", "", world_file(raster, slices.tau_m)});
    files.push_back({"slice", name + ".png.aux.xml", "", "", aux_file(raster, slices.tau_m, kLocalCrs)});
    files.push_back({"slice", name + ".png", "", "", {png.begin(), png.end()}});
  }
  return files;
}

}  // namespace roomcut

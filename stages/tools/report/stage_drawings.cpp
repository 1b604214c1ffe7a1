// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/stage_drawings.h"

#include <set>
#include <utility>

#include "common/mesh/mesh_io.h"
#include "common/slices/slices_io.h"
#include "common/sloped_planes/planes_io.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/tools/report/pass_pictures.h"

namespace roomcut::report {

namespace {

using Pictures = std::vector<Picture>;
using Draw = decltype(StageDrawing::draw);

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

void draw_sloped(const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
  pictures.push_back(draw_planes(read_planes_file(run.input("planes")).content, lines_of(run, "lines")));
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

/// The stages that work on cells: of the first pass, or of the second.
void add_pass(const std::string& prefix, const PassInputs& inputs, bool overview,
              std::vector<StageDrawing>& list) {
  const auto add = [&](const char* name, std::vector<std::string> needs, bool is_overview, auto draw) {
    const std::string stage = prefix + name;
    list.push_back({stage, std::move(needs), is_overview, false,
                    [=](const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
                      draw(run, inputs, stage, pictures);
                    }});
  };
  add("partition", {inputs.cells}, false, draw_partition_of);
  add("weigh_faces", {inputs.cells, inputs.weights}, false, draw_weights_of);
  add("raycast", {inputs.cells, inputs.terms}, false, draw_evidence_of);
  add("graphcut", {inputs.cells, inputs.terms, inputs.labels}, overview, draw_labels_of);
}

}  // namespace

std::vector<StageDrawing> stage_drawings(const std::vector<ThinPoint>& points) {
  const PassInputs first{"first_cells", "first_weights", "first_terms", "first_labels"};
  const PassInputs second{"cells", "weights", "terms", "labels"};
  std::vector<StageDrawing> list = {{"ingest", {"cloud"}, true, true, draw_scan(points)},
                                    {"slice", {"slices"}, true, false, draw_levels},
                                    {"detect_lines", {"slices", "detected"}, true, false, draw_detection},
                                    {"accept_lines", {"detected", "lines"}, false, false, draw_accepted},
                                    {"accept_planes", {"planes", "lines"}, false, false, draw_sloped}};
  add_pass("", first, false, list);
  list.push_back({"refine_lines", {"lines", "refined"}, true, false, draw_refined});
  add_pass("final_", second, true, list);
  list.push_back({"fit_surfaces",
                  {"cells", "surfaces"},
                  false,
                  false,
                  [second](const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
                    draw_surfaces_of(run, second, pictures);
                  }});
  list.push_back({"find_openings",
                  {"cells", "labels", "openings"},
                  false,
                  false,
                  [second](const StageRun& run, const ReportParams& /*params*/, Pictures& pictures) {
                    draw_openings_of(run, second, pictures);
                  }});
  list.push_back({"extract", {"model"}, true, true, draw_model_views});
  return list;
}

}  // namespace roomcut::report

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/report_io.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/artefact/frame_crs.h"
#include "common/slices/slices_io.h"
#include "stages/tools/report/occupancy_raster.h"
#include "stages/tools/report/stage_drawings.h"

namespace roomcut::report {

std::vector<StageFile> report_inputs() {
  return {{"cloud", "the cloud", true},
          {"slices", "the slices", true},
          {"detected", "the detected wall lines", true},
          {"hough", "what the detection saw", true},
          {"lines", "the accepted wall lines", true},
          {"planes", "the accepted sloped planes", true},
          {"refined", "the refined wall lines", true},
          {"first_cells", "the cells of the first pass", true},
          {"first_weights", "the weights of their faces", true},
          {"first_terms", "their data terms", true},
          {"first_labels", "their labels", true},
          {"cells", "the cells", true},
          {"weights", "the weights of their faces", true},
          {"terms", "their data terms", true},
          {"labels", "their labels", true},
          {"surfaces", "the true floors and ceilings", true},
          {"rooms", "storeys and rooms of the cells", true},
          {"openings", "the openings", true},
          {"model", "the model", true},
          {"summary", "its summary", true}};
}

std::vector<std::string> report_choices() {
  std::vector<std::string> choices = {"all", "pictures", "layers"};
  const std::vector<ThinPoint> none;
  for (const StageDrawing& drawing : stage_drawings(none)) {
    choices.push_back(drawing.stage);
  }
  return choices;
}

std::vector<Picture> draw_pictures(const StageRun& run, const ReportParams& params, const std::string& only,
                                   const std::vector<ThinPoint>& points,
                                   const std::function<void()>& meanwhile) {
  const bool overview = only == "all" || only == "pictures";
  std::vector<StageDrawing> drawings = stage_drawings(points);
  std::erase_if(drawings, [&](const StageDrawing& drawing) {
    const bool wanted = overview ? drawing.overview : drawing.stage == only;
    return !wanted || !std::all_of(drawing.needs.begin(), drawing.needs.end(),
                                   [&](const std::string& input) { return run.has_input(input); });
  });
  std::vector<std::vector<Picture>> drawn(drawings.size());
  const auto draw = [&](std::size_t i) { drawings[i].draw(run, params, drawn[i]); };
  const auto draw_others = [&] {
    for (std::size_t i = 0; i < drawings.size(); ++i) {
      if (!drawings[i].rendered) draw(i);
    }
    meanwhile();
  };
  // HDF5 takes calls from one thread at a time: all that reads artefacts is one task.
  std::vector<std::function<void()>> tasks{draw_others};
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    if (drawings[i].rendered) tasks.emplace_back([&draw, i] { draw(i); });
  }
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) { tasks[i](); });
  std::vector<Picture> pictures;
  for (std::vector<Picture>& some : drawn) {
    std::move(some.begin(), some.end(), std::back_inserter(pictures));
  }
  return pictures;
}

std::vector<Picture> draw_layers(const StageRun& run) {
  std::vector<Picture> files;
  const Slices slices = read_slices(run.input("slices"));
  const std::string crs = crs_of(slices.frame);
  for (std::size_t k = 0; k < slices.wall_slices.size(); ++k) {
    const GridRaster raster = occupancy_raster(slices, k);
    const RasterPlace place = place_of(raster, slices.tau_m, slices.frame);
    const std::string name = "slice_" + std::to_string(k);
    const auto png = encode_png(raster.image, PngPixels::kRgb);
    files.push_back({"slice", name + ".pgw", "", "", world_file(place)});
    files.push_back({"slice", name + ".png.aux.xml", "", "", aux_file(place, crs)});
    if (crs == slices.frame.crs && crs.find('[') != std::string::npos) {
      files.push_back({"slice", name + ".prj", "", "", crs + "\n"});
    }
    files.push_back({"slice", name + ".png", "", "", {png.begin(), png.end()}});
  }
  return files;
}

}  // namespace roomcut::report

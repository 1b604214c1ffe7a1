// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "common/artefact/atomic_file.h"
#include "common/artefact/unsynced_file.h"
#include "common/cli/run_stage.h"
#include "stages/tools/report/report_io.h"
#include "stages/tools/report/thinned_points.h"

namespace {

using namespace roomcut;
using namespace roomcut::report;

/// The pictures of `make run`: SVG documents, and PNG files as they are.
void write_overview(StageRun& run, const std::vector<Picture>& pictures) {
  const auto folder = run.output("report").parent_path() / "pictures";
  for (const Picture& picture : pictures) {
    const bool raster = picture.file.ends_with(".png");
    write_unsynced_file(folder / picture.file, raster ? picture.bytes : captioned(picture));
    run.wrote(folder / picture.file);
  }
}

/// Every picture as SVG, those that are rasters also as PNG; the files' names go to standard output.
void write_plots(StageRun& run, const std::vector<Picture>& pictures) {
  const std::filesystem::path pictures_folder = "pictures";
  const auto work = run.output("report").parent_path();
  for (const Picture& picture : pictures) {
    const auto file = pictures_folder / picture.file;
    auto svg = file;
    svg.replace_extension(".svg");
    write_unsynced_file(work / svg, captioned(picture));
    std::cout << svg.string() << "\n";
    if (file != svg) {
      write_unsynced_file(work / file, picture.bytes);
      std::cout << file.string() << "\n";
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  ReportParams params;
  StageInfo info;
  info.name = "report";
  info.revision = 5;
  info.summary = "Draws every stage whose artefacts are there, and a page that shows them all.";
  info.inputs = report_inputs();
  info.outputs = {{"report", "the page; the pictures go to the folder pictures/ beside it"}};
  info.options = {
      {"only", "all", "draw the result of one stage, or only some files; the page is then left as it is",
       report_choices()},
      {"template", "", "the page without data; empty: report_page.html beside this program", {}}};
  return run_stage(argc, argv, info, parameters(params), [&](StageRun& run) {
    const std::string& only = run.option("only");
    const auto page = run.output("report");
    if (only == "layers") {
      for (const Picture& file : draw_layers(run)) {
        write_unsynced_file(page.parent_path() / "edits" / file.file, file.bytes);
      }
      return;
    }
    std::vector<ThinPoint> points;
    if ((only == "all" || only == "pictures" || only == "ingest") && run.has_input("cloud")) {
      points = thinned_points(run, static_cast<std::uint64_t>(params.cloud_points));
    }
    std::string html;
    const auto pictures = draw_pictures(run, params, only, points, [&] {
      if (only == "all") html = make_page(run, points);
    });
    run.count("pictures", static_cast<double>(pictures.size()));
    if (only != "all") {
      write_plots(run, pictures);
      return;
    }
    write_overview(run, pictures);
    write_text_file(page, html);
    run.count("page", static_cast<double>(html.size()) / 1e6, "MB");
  });
}

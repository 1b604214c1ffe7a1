// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/atomic_file.h"
#include "common/artefact/unsynced_file.h"
#include "common/cli/run_stage.h"
#include "stages/report/report_io.h"
#include "stages/report/thinned_points.h"

int main(int argc, char** argv) {
  using namespace roomcut;
  ReportParams params;
  StageInfo info;
  info.name = "report";
  info.revision = 2;
  info.summary = "Draws every stage whose artefacts are there, and a page that shows them all.";
  info.inputs = report_inputs();
  info.outputs = {{"report", "report.html", "the page; the pictures go to the folder pictures/ beside it"}};
  info.options = {{"only",
                   "all",
                   "draw one stage only; the page is then left as it is",
                   {"all", "ingest", "slice", "detect_lines", "graphcut", "refine_lines", "extract"}},
                  {"template", "", "the page without data; empty: report_page.html beside this program", {}}};
  return run_stage(argc, argv, info, report_table(params), [&](StageRun& run) {
    const std::string& only = run.option("only");
    const auto page = run.output("report");
    std::vector<ThinPoint> points;
    if ((only == "all" || only == "ingest") && run.has_input("cloud")) {
      points = thinned_points(run, static_cast<std::uint64_t>(params.cloud_points));
    }
    const auto pictures = draw_pictures(run, params, only, points);
    for (const Picture& picture : pictures) {
      write_unsynced_file(page.parent_path() / "pictures" / picture.file, picture.bytes);
    }
    run.count("pictures", static_cast<double>(pictures.size()));
    if (only == "all") {
      const std::string html = make_page(run, points);
      write_text_file(page, html);
      run.count("page", static_cast<double>(html.size()) / 1e6, "MB");
    }
  });
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "common/artefact/atomic_file.h"
#include "stages/tools/report/page_blocks.h"
#include "stages/tools/report/report_io.h"

namespace roomcut::report {

namespace {

constexpr const char* kPlainPage =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>roomcut "
    "report</title></head><body>\n"
    "<p>This build of roomcut has no front end: npm's registry could not be reached when it was built. Run "
    "<code>make build</code> again, then <code>make rerun-report</code>. The pictures lie in "
    "<a href=\"pictures/\">pictures/</a>.</p>\n<!--roomcut-data--></body></html>\n";

std::string page_template(StageRun& run) {
  std::filesystem::path file = run.option("template");
  if (file.empty()) {
    std::error_code error;
    file = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "report_page.html";
    if (!std::filesystem::exists(file, error)) {
      run.warn(
          "this build has no front end, so that report.html holds no more than a note: run make build "
          "where npm's registry can be reached");
      return kPlainPage;
    }
  }
  return read_text_file(file);
}

}  // namespace

std::string make_page(StageRun& run, const std::vector<ThinPoint>& points) {
  const std::string html = page_template(run);
  std::vector<PageBlock> blocks;
  add_run_blocks(run, blocks);
  add_log_block(run, blocks);
  add_plan_blocks(run, blocks);
  add_model_blocks(run, points, blocks);
  return fill_template(html, blocks);
}

}  // namespace roomcut::report

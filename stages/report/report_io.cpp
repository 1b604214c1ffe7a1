// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/report/report_io.h"

#include <cstdio>
#include <set>

#include "common/artefact/json.h"
#include "common/cells/cells_io.h"
#include "common/cloud/cloud_io.h"
#include "common/mesh/mesh_io.h"
#include "common/slices/slices_io.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

namespace {

/// Every n-th point, so that at most about `most` remain, tile by tile; of a scan with a model only the
/// points around it, since ghosts far outside would make everything else small.
std::vector<Vec3> thinned_points(const StageRun& run, std::uint64_t most) {
  const CloudReader cloud(run.input("cloud"));
  const CloudHeader& header = cloud.header();
  Bounds3 shown{header.bbox_min, header.bbox_max};
  if (run.has_input("model")) {
    const Vec3 origin(header.frame.origin[0], header.frame.origin[1], header.frame.origin[2]);
    shown = bounds(read_mesh(run.input("model")));
    shown.lo -= origin + Vec3::Constant(1);
    shown.hi -= origin - Vec3::Constant(1);
  }
  const std::uint64_t step = header.points / std::max<std::uint64_t>(most, 1) + 1;
  std::vector<Vec3> points;
  CloudTile tile;
  for (std::size_t t = 0; t < cloud.tiles(); ++t) {
    cloud.read_tile(t, tile);
    for (std::size_t i = 0; i < tile.size(); i += step) {
      const Vec3 p(tile.x[i], tile.y[i], tile.z[i]);
      if ((p.array() >= shown.lo.array()).all() && (p.array() <= shown.hi.array()).all()) {
        points.push_back(p);
      }
    }
  }
  return points;
}

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

std::string text_of(const Json& value) {
  if (value.is_number_float()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", value.get<double>());
    return text;
  }
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// A list of equal objects as a table, columns by name; members that are lists or objects are left out.
ReportTable table_of(const std::string& title, const Json& list) {
  ReportTable table{title, {}};
  for (const Json& item : list) {
    std::vector<std::string> head, row;
    for (const auto& [key, value] : item.items()) {
      if (!value.is_structured()) {
        head.push_back(key);
        row.push_back(text_of(value));
      }
    }
    if (table.rows.empty()) {
      table.rows.push_back(head);
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

std::vector<StageFile> report_inputs() {
  return {{"cloud", "10_ingest/cloud.h5", "the cloud", true},
          {"slices", "20_slice/slices.h5", "the slices", true},
          {"lines", "40_accept_lines/wall_lines.geojson", "the accepted wall lines", true},
          {"refined", "80_refine_lines/wall_lines.geojson", "the refined wall lines", true},
          {"cells", "90_final/cells.h5", "the cells", true},
          {"terms", "90_final/data_terms.h5", "their data terms", true},
          {"labels", "90_final/labels.h5", "their labels", true},
          {"model", "model.ply", "the model", true},
          {"summary", "summary.json", "its summary", true}};
}

std::vector<Picture> draw_pictures(const StageRun& run, const ReportParams& params, const std::string& only) {
  const auto wanted = [&](const char* stage) { return only == "all" || only == stage; };
  std::vector<Picture> pictures;
  if (wanted("extract") && run.has_input("model")) {
    draw_models(run, params.picture_px, pictures);
  }
  if (wanted("ingest") && run.has_input("cloud")) {
    pictures.push_back(
        draw_cloud(thinned_points(run, static_cast<std::uint64_t>(params.cloud_points)), params.picture_px));
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

std::vector<ReportTable> summary_tables(const std::filesystem::path& summary) {
  const Json json = read_json_artefact(summary, artefacts::kSummary);
  std::vector<ReportTable> tables;
  for (const char* list : {"storeys", "rooms"}) {
    if (json.contains(list) && json[list].is_array() && !json[list].empty()) {
      tables.push_back(table_of(list, json[list]));
    }
  }
  for (const char* group : {"totals", "counts", "checks"}) {
    if (json.contains(group) && json[group].is_object()) {
      ReportTable table{group, {{"what", "value"}}};
      for (const auto& [key, value] : json[group].items()) {
        table.rows.push_back({key, text_of(value)});
      }
      tables.push_back(table);
    }
  }
  return tables;
}

}  // namespace roomcut

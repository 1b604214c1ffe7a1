// SPDX-License-Identifier: GPL-3.0-or-later
// usage: bench_kernels --work=FOLDER --scan=FILE [options of Google Benchmark]: the loops that a run spends
// its time in, on the artefacts of a work folder. Points are in memory; items per second are points, or
// cells.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>

#include "common/cells/cells_io.h"
#include "common/cloud/cloud_io.h"
#include "stages/graphcut/graphcut.h"
#include "stages/ingest/ingest.h"
#include "stages/raycast/raycast.h"
#include "stages/slice/slice.h"
#include "stages/weigh_faces/weigh_faces.h"

namespace {

using namespace roomcut;

/// What the kernels work on: a scan, and the artefacts of a run on it.
struct Material {
  Material(const std::filesystem::path& scan_file, const std::filesystem::path& work)
      : scan(ingest::open_scan(scan_file)),
        header(CloudReader(work / "10_ingest/cloud.h5").header()),
        cells(read_cells(work / "50_partition/cells.h5")),
        weights(read_weights(work / "55_weigh_faces/weights.h5", cells)),
        terms(read_data_terms(work / "60_raycast/data_terms.h5", cells)) {
    const CloudReader cloud(work / "10_ingest/cloud.h5");
    tiles.resize(cloud.tiles());
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      cloud.read_tile(i, tiles[i]);
    }
  }
  std::unique_ptr<ingest::ScanReader> scan;
  CloudHeader header;
  std::vector<CloudTile> tiles;
  CellsFile cells;
  FaceWeights weights;
  DataTerms terms;
};

void count(benchmark::State& state, double items) {
  state.counters["items"] = benchmark::Counter(items, benchmark::Counter::kIsIterationInvariantRate);
}

void sort_into_tiles(benchmark::State& state, const Material& material) {
  for (auto step : state) {
    benchmark::DoNotOptimize(ingest::tile_scan(*material.scan, {}, {}));
  }
  count(state, static_cast<double>(material.header.points));
}

void class_points(benchmark::State& state, const Material& material) {
  const ingest::TiledScan scan = ingest::tile_scan(*material.scan, {}, {});
  for (auto step : state) {
    std::size_t points = 0;
    ingest::class_tiles(scan, {}, [&](const CloudTile& part, bool /*last*/) { points += part.size(); });
    benchmark::DoNotOptimize(points);
  }
  count(state, static_cast<double>(material.header.points));
}

void find_levels_and_slices(benchmark::State& state, const Material& material) {
  const slice::TileSource tiles = [&](const slice::TileVisitor& visit) {
    for (std::size_t i = 0; i < material.tiles.size(); ++i) {
      visit(i, material.tiles[i]);
    }
  };
  for (auto step : state) {
    benchmark::DoNotOptimize(slice::slice_cloud(material.header, tiles, {}));
  }
  count(state, static_cast<double>(material.header.points));
}

void add_points_to_faces(benchmark::State& state, const Material& material) {
  weigh_faces::FaceWeigher weigher(material.cells.complex, material.header, {});
  for (auto step : state) {
    for (const CloudTile& tile : material.tiles) {
      weigher.add(tile);
    }
  }
  count(state, static_cast<double>(material.header.points));
}

void cast_all_rays(benchmark::State& state, const Material& material) {
  for (auto step : state) {
    benchmark::DoNotOptimize(raycast::cast_rays(material.cells.complex, material.weights, {}));
  }
  count(state, static_cast<double>(material.cells.complex.cells()));
}

void cut_graph(benchmark::State& state, const Material& material) {
  for (auto step : state) {
    benchmark::DoNotOptimize(
        graphcut::graphcut(material.cells.complex, material.weights, material.terms, {}));
  }
  count(state, static_cast<double>(material.cells.complex.cells()));
}

/// The value of an argument --name=value, which is taken out of argv.
std::string take_option(int& argc, char** argv, std::string_view name) {
  std::string value;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word.starts_with(name)) {
      value = word.substr(name.size());
    } else {
      argv[kept++] = argv[i];
    }
  }
  argc = kept;
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string work = take_option(argc, argv, "--work=");
  const std::string scan = take_option(argc, argv, "--scan=");
  if (work.empty() || scan.empty()) {
    std::cerr << "usage: bench_kernels --work=FOLDER --scan=FILE [options of Google Benchmark]\n";
    return 2;
  }
  try {
    const Material material(scan, work);
    const auto add = [&](const char* name, auto kernel) {
      benchmark::RegisterBenchmark(name,
                                   [&material, kernel](benchmark::State& state) { kernel(state, material); })
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime();
    };
    add("ingest/sort_into_tiles", sort_into_tiles);
    add("ingest/class_points", class_points);
    add("slice/levels_and_slices", find_levels_and_slices);
    add("weigh_faces/add_points", add_points_to_faces);
    add("raycast/all_rays", cast_all_rays);
    add("graphcut/cut", cut_graph);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << "bench_kernels: " << error.what() << "\n";
    return 1;
  }
  return 0;
}

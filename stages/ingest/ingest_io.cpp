// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/ingest_io.h"

#include <charconv>
#include <cmath>
#include <future>

#include "common/artefact/sha256.h"
#include "common/cloud/cloud_io.h"
#include "common/errors/codes.h"
#include "stages/ingest/ingest.h"
#include "stages/ingest/lean.h"
#include "stages/ingest/scan_stations.h"
#include "stages/ingest/text_columns.h"
#include "stages/ingest/up_axis.h"

namespace roomcut::ingest {

namespace {

/// The scan's digest: given, or computed beside the first pass.
std::future<std::string> start_digest(const StageRun& run) {
  const std::string& given = run.option("scan-sha256");
  if (!given.empty()) {
    if (given.size() != 64 || given.find_first_not_of("0123456789abcdef") != std::string::npos) {
      throw StageError(errors::kUsage, "--scan-sha256", "is no SHA-256 digest",
                       "give 64 hexadecimal digits, or nothing");
    }
    return std::async(std::launch::deferred, [given] { return given; });
  }
  return std::async(std::launch::async, [path = run.input("scan")] { return sha256_of_file(path); });
}

/// The build folder: this program lies in its bin/.
std::filesystem::path program_folder() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path().parent_path();
}

std::uint64_t memory_bytes(const StageRun& run) {
  const std::string& text = run.option("memory-mib");
  std::uint64_t mib = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), mib);
  if (error != std::errc() || end != text.data() + text.size() || mib > (std::uint64_t{1} << 30)) {
    throw StageError(errors::kUsage, "--memory-mib", "'" + text + "' is no number of MiB",
                     "give a whole number");
  }
  return mib << 20;
}

constexpr double kSparse = 15;  // points per m^2: 3 of 14 rooms were lost at 12.5, none at 15.6

void report(StageRun& run, const TiledScan& scan, const SurfaceSummary& summary, const CloudHeader& header) {
  const IngestCounts& counts = scan.counts;
  run.count("points read", static_cast<double>(counts.read));
  run.count("kept", static_cast<double>(counts.kept));
  run.count("no return", static_cast<double>(counts.no_returns));
  run.count("invalid", static_cast<double>(counts.invalid));
  run.count("not finite", static_cast<double>(counts.not_finite));
  run.count("duplicates", static_cast<double>(counts.duplicates));
  run.count("thin", static_cast<double>(counts.thin));
  run.count("ghosts", static_cast<double>(counts.ghosts));
  run.count("noise", 1000 * header.noise_m, "mm");
  run.count("density", header.density, "per m^2");
  run.count("stations", static_cast<double>(header.stations.size()));
  if (counts.no_returns > 0) {
    run.warn(std::to_string(counts.no_returns) +
             " points are exactly 0 0 0, beams without return, and were dropped");
  }
  if (counts.invalid > 0) {
    run.warn(std::to_string(counts.invalid) + " points are marked as invalid in the file and were dropped");
  }
  if (counts.not_finite > 0) {
    run.warn(std::to_string(counts.not_finite) + " points with NaN or infinite coordinates were dropped");
  }
  if (counts.duplicates > 0) {
    run.warn(std::to_string(counts.duplicates) +
             " points are duplicates: they have exactly the coordinates of another one, show nothing that it "
             "does not show, and were dropped");
  }
  if (header.density > 0 && header.density < kSparse) {
    run.warn(
        "the scan has only " + std::to_string(std::lround(header.density)) +
        " points per square metre where it shows surfaces: walls, floors and whole rooms may be missing, "
        "from about " +
        std::to_string(std::lround(kSparse)) + " on they are found");
  }
  if (counts.thin > 0) {
    run.warn("the model ends where the points get thin: about " +
             std::to_string(std::lround(scan.thin_reach_m)) + " m of scan with only " +
             std::to_string(counts.thin) + " points were left out");
  }
  if (counts.ghosts > 0) {
    run.warn(std::to_string(counts.ghosts) + " ghosts, sparse points far from the building, were dropped");
  }
  if (summary.tiles_with_refused_normals > 0) {
    run.warn("the file's normals contradict its points in " +
             std::to_string(summary.tiles_with_refused_normals) + " of " + std::to_string(scan.tiles.size()) +
             " tiles and were not used there");
  }
  if (scan.step_m > 0.005) {
    run.warn("the coordinates are rounded to " + std::to_string(1000 * scan.step_m) + " mm in the file");
  }
  if (summary.estimates.noise.total() == 0) {
    run.warn("no neighbourhood of points lies clearly on a plane: is the unit right, the scan dense enough?");
  }
}

}  // namespace

StageInfo ingest_info() {
  StageInfo info;
  info.name = "ingest";
  info.revision = 7;
  info.summary = "Reads a raw scan; finds surface class, azimuth, noise and density from sums in voxels.";
  info.inputs = {
      {"scan", "The scan: PLY, E57, LAS, LAZ, PCD, PTX or text (.xyz .txt .csv .pts .asc)"},
      {"stations", "Scanner positions as text, x y z on each line, in the scan's unit and axes", true}};
  info.inputs[0].by_bytes = true;
  info.inputs[1].by_bytes = true;
  info.outputs = {{"cloud", "The points in tiles, with class, azimuth and area"}};
  info.options = {
      {"up", "z", "The scan's up axis", {"x", "y", "z", "-x", "-y", "-z"}},
      {"unit", "m", "The scan's length unit", {"m", "mm", "cm", "ft"}},
      {"columns", "", "What each column of a text is, in order: x,y,z,nx,ny,nz, '-' for others", {}},
      {"level",
       "yes",
       "Turn a scan that leans by 0.3 to 5 degrees, so that its floors are level",
       {"yes", "no"}},
      {"memory-mib", "256", "Points held in memory between the passes; more go to a scratch file", {}},
      {"scan-sha256", "", "Digest of the scan's bytes, when it is known already", {}}};
  return info;
}

namespace {

constexpr double kLevelled_deg = 0.3;  // less is the noise of real floors
constexpr double kLargest_deg = 5;

/// Both passes over a scan, the cloud written but not published.
struct MadeCloud {
  TiledScan scan;
  SurfaceSummary summary;
  AxisAreas areas;
  FloorFit floors;
  std::unique_ptr<CloudWriter> writer;
};

MadeCloud make_cloud(StageRun& run, const ScanReader& reader, const ScanSettings& settings,
                     const IngestParams& params, const std::vector<Vec3>& stations,
                     const std::shared_future<std::string>& digest) {
  MadeCloud cloud;
  Progress reading = run.progress("reading blocks", (settings.middle ? 1 : 2) * reader.blocks());
  cloud.scan = tile_scan(reader, settings, params, [&](std::uint64_t blocks) { reading.advance(blocks); });
  run.set_input_digest("scan", digest.get());
  cloud.writer = std::make_unique<CloudWriter>(run.output("cloud"), run.provenance(),
                                               header_of(cloud.scan, stations, reader.crs(), params));
  Progress classing = run.progress("classing points", cloud.scan.counts.kept);
  cloud.summary = class_tiles(
      cloud.scan, params,
      [&](const CloudTile& part, bool last) {
        cloud.areas.add(part);
        cloud.floors.add(part);
        cloud.writer->append(part, last);
      },
      [&](std::uint64_t points) { classing.advance(points); });
  return cloud;
}

std::string degrees_text(double degrees) {
  const auto hundredths = std::llround(100 * degrees);
  const std::string rest = std::to_string(hundredths % 100);
  return std::to_string(hundredths / 100) + "." + (rest.size() < 2 ? "0" : "") + rest + " degrees";
}

/// Whether the scan is to be levelled by the lean of its floors; says why not. Errors: kScanLeans.
bool wants_levelling(StageRun& run, const Lean& lean) {
  if (lean.degrees < kLevelled_deg) {
    return false;
  }
  const std::string angle = degrees_text(lean.degrees);
  if (!lean.walls_agree) {
    run.warn("the floors lean by " + angle + ", which the walls do not confirm: not levelled");
    return false;
  }
  if (run.option("level") == "no") {
    run.warn("the scan leans by " + angle + " and is not levelled (--level no)");
    return false;
  }
  if (lean.degrees > kLargest_deg) {
    throw StageError(
        errors::kScanLeans, run.input("scan").string(),
        "floors and walls lean by " + angle + ", more than is levelled",
        "level the scan when exporting it, or give --up if another axis is up; --level no reads it as it is");
  }
  return true;
}

}  // namespace

void run_ingest(StageRun& run, const IngestParams& params) {
  const std::filesystem::path output = run.output("cloud");
  const std::filesystem::path folder =
      output.has_parent_path() ? output.parent_path() : std::filesystem::path(".");
  const std::unique_ptr<ScanReader> reader =
      open_scan(run.input("scan"), {parse_columns(run.option("columns")), folder, program_folder()});
  for (const std::string& note : reader->notes()) {
    run.note(note);
  }
  for (const std::string& warning : reader->warnings()) {
    run.warn(warning);
  }
  std::vector<Vec3> stations = reader->stations();
  if (!run.input("stations").empty()) {
    stations = read_stations(run.input("stations"));
  }
  const std::shared_future<std::string> digest = start_digest(run).share();
  ScanSettings settings;
  settings.unit = run.option("unit");
  settings.up = run.option("up");
  settings.memory_bytes = memory_bytes(run);
  settings.scratch_folder = folder;
  settings.name = run.input("scan").string();
  MadeCloud cloud = make_cloud(run, *reader, settings, params, stations, digest);
  for (const std::string& note : reader->late_notes()) {
    run.note(note);
  }
  for (const std::string& warning : reader->late_warnings()) {
    run.warn(warning);
  }
  const Lean lean = lean_of(cloud.summary.estimates.lean, cloud.floors);
  if (wants_levelling(run, lean)) {
    settings.middle = cloud.scan.middle;
    settings.level = lean.up;
    cloud = {};  // what was written is not published
    cloud = make_cloud(run, *reader, settings, params, stations, digest);
    run.warn("the scan leans by " + degrees_text(lean.degrees) +
             "; it was levelled by its floors, and the model is turned back (--level no: make LEVEL=no)");
  }
  CloudHeader& header = cloud.writer->header();
  header.noise_m = noise_of(cloud.summary.estimates, cloud.scan.step_m);
  header.density = density_of(cloud.summary.estimates);
  cloud.writer->finish();
  report(run, cloud.scan, cloud.summary, header);
  run.count("lean", lean.degrees, "degrees");
  if (const std::string question =
          upright_floors(cloud.areas, header.bbox_min, header.bbox_max, run.option("up"));
      !question.empty()) {
    run.warn(question);
  }
}

}  // namespace roomcut::ingest

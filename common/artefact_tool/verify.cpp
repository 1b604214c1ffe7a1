// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "common/artefact/h5.h"
#include "common/artefact/json_values.h"
#include "common/artefact_digest/artefact_digest.h"
#include "common/artefact_tool/commands.h"
#include "common/artefact_tool/schema_check.h"
#include "common/errors/codes.h"
#include "common/mesh/mesh_check.h"
#include "common/mesh/mesh_io.h"
#include "common/rerun/stamp.h"
#include "common/rerun/work_digests.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

/// Whether the input that lies there now is the one that `record` names; files outside the work folder are
/// not looked at.
bool is_still(const InputRecord& record, const fs::path& folder) {
  const fs::path path = folder / record.path;
  std::error_code error;
  if (!fs::path(record.path).has_parent_path() || !fs::is_regular_file(path, error)) {
    return true;
  }
  const std::string now =
      record.schema_version.empty() ? sha256_of_file(path) : inspect_artefact(path).payload_sha256;
  return now == record.payload_sha256;
}

/// What the stage's parameters are now, as pipeline.sh asked them last, against those that made the artefact.
void check_parameters(const fs::path& path, const Provenance& made, std::vector<Problem>& problems) {
  const fs::path file = "params/" + made.stage + ".json";
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return;
  }
  const Json now = try_parse_json(read_text_file(file));
  const Json then = try_parse_json(made.params_json);
  if (!now.is_object() || !now.contains("params") || now["params"] != then ||
      now.value("revision", 0) != made.stage_revision) {
    problems.push_back({errors::kArtefactMismatch, path.string(),
                        "was made with other parameters than " + file.string() + " holds now",
                        "make run brings it up to date; make status says what changed"});
  }
}

void check_provenance(const fs::path& path, const VerifyOptions& options, std::vector<Problem>& problems) {
  const Provenance provenance = read_provenance(path);
  if (sha256_hex(provenance.params_json) != provenance.params_sha256) {
    problems.push_back({errors::kArtefactDamaged, path.string(),
                        "its parameters do not have the digest that it states", "delete it and run make"});
  }
  check_parameters(path, provenance, problems);
  for (const InputRecord& input : provenance.inputs) {
    if (!is_still(input, path.parent_path())) {
      problems.push_back({errors::kArtefactMismatch, path.string(),
                          "was made from another version of " + input.path, "make run brings it up to date"});
    }
    std::error_code error;
    if (input.name == "scan" && fs::is_regular_file(options.scan, error) &&
        sha256_of_file(options.scan) != input.payload_sha256) {
      problems.push_back({errors::kArtefactMismatch, path.string(),
                          "was made from other bytes than " + options.scan.string() + " holds now",
                          "make run brings it up to date"});
    }
  }
}

void check_schema(const fs::path& path, const std::string& artefact, const VerifyOptions& options,
                  std::vector<Problem>& problems) {
  const fs::path schema = options.schemas / (artefact + ".schema.json");
  std::error_code error;
  const bool json = path.extension() == ".json" || path.extension() == ".geojson";
  if (options.schemas.empty() || !json || !fs::is_regular_file(schema, error)) {
    return;
  }
  for (const std::string& violation : schema_violations(path, schema)) {
    problems.push_back({errors::kArtefactDamaged, path.string(),
                        violation + " (" + schema.filename().string() + ")", "delete it and run make"});
  }
}

/// The volume that the summary beside a model states [m^3]; NaN when there is none.
double stated_volume(const fs::path& model) {
  const fs::path summary = model.parent_path() / "summary.json";
  std::error_code error;
  if (!fs::is_regular_file(summary, error)) {
    return std::nan("");
  }
  const Json json = read_json_artefact(summary, artefacts::kSummary);
  return json.value("/mesh/volume_m3"_json_pointer, std::nan(""));
}

void check_model(const fs::path& path, std::vector<Problem>& problems) {
  constexpr double kSameVolume = 1e-6;  // relative: both are sums of the same triangles
  const MeshCheck mesh = check_mesh(read_mesh(path));
  const char* remedy = "make rerun-extract; if it stays so, this is a bug in roomcut";
  if (!mesh.valid()) {
    problems.push_back({errors::kMeshInvalid, path.string(), describe_faults(mesh), remedy});
  }
  const double stated = stated_volume(path);
  if (std::abs(mesh.volume_m3 - stated) > kSameVolume * std::abs(stated)) {
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(), "encloses %.4f m3, summary.json states %.4f m3", mesh.volume_m3,
                  stated);
    problems.push_back({errors::kArtefactMismatch, path.string(), text.data(), remedy});
  }
}

void check(const StampEntry& entry, const VerifyOptions& options, std::vector<Problem>& problems) {
  const std::string name = entry.name;
  std::error_code error;
  if (!fs::is_regular_file(entry.name, error)) {
    problems.push_back({errors::kArtefactMissing, name, "is missing", "make run makes it again"});
    return;
  }
  const std::size_t before = problems.size();
  const InputRecord stated = inspect_artefact(entry.name);
  if (stated.payload_sha256 != entry.sha256 || content_digest(entry.name, payload_digest) != entry.content) {
    problems.push_back(
        {errors::kArtefactMismatch, name, "is not the file that its stage wrote", "delete it and run make"});
  }
  check_schema(entry.name, stated.artefact, options, problems);
  verified_artefact(entry.name);  // throws for a content that has not the digest that it states
  if (!stated.artefact.empty()) {
    check_provenance(entry.name, options, problems);
  }
  if (fs::path(entry.name).filename() == "model.ply") {
    check_model(entry.name, problems);
  }
  if (problems.size() == before) {
    std::cout << "ok  " << name << "\n";
  }
}

}  // namespace

void verify(const std::vector<fs::path>& stamps, const VerifyOptions& options) {
  std::vector<Problem> problems;
  for (const fs::path& stamp : stamps) {
    const StampFile file = read_stamp(stamp);
    if (file.state != StampState::kWhole) {
      problems.push_back(
          {errors::kArtefactDamaged, stamp.string(), "does not say what the stage read and wrote",
           "make run makes it again: it is like this when an older roomcut wrote it, or when the "
           "machine lost power"});
    }
    for (const StampEntry& entry : file.stamp.outputs) {
      try {
        check(entry, options, problems);
      } catch (const StageError& error) {
        problems.insert(problems.end(), error.problems().begin(), error.problems().end());
      }
    }
  }
  if (!problems.empty()) {
    throw StageError(std::move(problems));
  }
}

}  // namespace roomcut

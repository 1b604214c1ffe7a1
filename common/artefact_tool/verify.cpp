// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "common/artefact/h5.h"
#include "common/artefact/json.h"
#include "common/artefact_tool/commands.h"
#include "common/errors/codes.h"
#include "common/openings/openings_io.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

std::string actual_digest(const fs::path& path, const InputRecord& stated) {
  if (stated.artefact.empty()) {
    return stated.payload_sha256;  // no artefact: this is already the digest of the bytes
  }
  if (stated.artefact == artefacts::kWallLines.name) {
    return wall_lines_payload_sha256(read_wall_lines(path).content);
  }
  if (stated.artefact == artefacts::kOpenings.name) {
    return read_openings(path).payload_sha256;
  }
  return recompute_payload_sha256(path);
}

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

void check(const StampEntry& entry, std::vector<Problem>& problems) {
  const std::string name = entry.path.string();
  std::error_code error;
  if (!fs::is_regular_file(entry.path, error)) {
    problems.push_back({errors::kArtefactMissing, name, "is missing", "make run makes it again"});
    return;
  }
  const std::size_t before = problems.size();
  const InputRecord stated = inspect_artefact(entry.path);
  if (stated.payload_sha256 != entry.sha256) {
    problems.push_back(
        {errors::kArtefactMismatch, name, "is not the file that its stage wrote", "delete it and run make"});
  }
  if (actual_digest(entry.path, stated) != stated.payload_sha256) {
    problems.push_back({errors::kArtefactDamaged, name, "its content does not have the digest that it states",
                        "delete it and run make"});
  }
  if (!stated.artefact.empty()) {
    for (const InputRecord& input : read_provenance(entry.path).inputs) {
      if (!is_still(input, entry.path.parent_path())) {
        problems.push_back({errors::kArtefactMismatch, name, "was made from another version of " + input.path,
                            "make run brings it up to date"});
      }
    }
  }
  if (problems.size() == before) {
    std::cout << "ok  " << name << "\n";
  }
}

}  // namespace

void verify(const std::vector<fs::path>& stamps) {
  std::vector<Problem> problems;
  for (const fs::path& stamp : stamps) {
    for (const StampEntry& entry : read_stamp(stamp)) {
      try {
        check(entry, problems);
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

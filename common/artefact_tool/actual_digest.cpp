// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact_tool/actual_digest.h"

#include "common/artefact/h5.h"
#include "common/openings/openings_io.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

std::string actual_digest(const std::filesystem::path& path) {
  const InputRecord stated = inspect_artefact(path);
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

}  // namespace roomcut

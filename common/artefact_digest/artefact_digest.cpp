// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact_digest/artefact_digest.h"

#include "common/artefact/h5.h"
#include "common/openings/openings_io.h"
#include "common/sloped_planes/planes_io.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

InputRecord verified_artefact(const std::filesystem::path& path) {
  InputRecord stated = stated_artefact(path);
  if (stated.artefact.empty()) {
    stated.payload_sha256 = sha256_of_file(path);
  } else if (stated.artefact == artefacts::kWallLines.name) {
    stated.payload_sha256 = read_wall_lines(path).payload_sha256;
  } else if (stated.artefact == artefacts::kPlanes.name) {
    stated.payload_sha256 = read_planes_file(path).payload_sha256;
  } else if (stated.artefact == artefacts::kOpenings.name) {
    stated.payload_sha256 = read_openings(path).payload_sha256;
  } else {
    stated = verified_plain_artefact(path);
  }
  return stated;
}

std::string payload_digest(const std::filesystem::path& path) {
  return verified_artefact(path).payload_sha256;
}

}  // namespace roomcut

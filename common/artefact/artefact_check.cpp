// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/artefact_check.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "common/artefact/limits.h"
#include "common/artefact/sha256.h"
#include "common/errors/codes.h"

namespace roomcut {

void throw_damaged(const std::filesystem::path& path, const std::string& place, const std::string& what) {
  throw StageError(errors::kArtefactDamaged, path.string() + (place.empty() ? "" : ": " + place), what,
                   kMakeAgain);
}

void throw_unreadable(const std::filesystem::path& path, int error) {
  const char* remedy = error == ENOENT   ? "run the stage that writes it (`make run` makes all of them)"
                       : error == EACCES ? "give yourself the permission to read it"
                                         : "is it a file, and does the disk work?";
  throw StageError(
      errors::kArtefactMissing, path.string(),
      error == ENOENT ? "there is no such file" : std::string("cannot be opened: ") + std::strerror(error),
      remedy);
}

void require_payload(const std::filesystem::path& path, const std::string& stated,
                     const std::string& actual) {
  if (kDigestsCount && stated != actual) {
    throw_damaged(path, "", kNotAsWritten);
  }
}

void require_params(const std::filesystem::path& path, const Provenance& provenance) {
  if (kDigestsCount && !provenance.params_sha256.empty() &&
      sha256_hex(provenance.params_json) != provenance.params_sha256) {
    throw_damaged(path, "provenance", "the parameters do not have the digest that is stated with them");
  }
}

void require_sane(const std::filesystem::path& path, const Frame& frame) {
  for (const double coordinate : frame.origin) {
    if (!(std::abs(coordinate) <= limits::kFarthestOrigin_m)) {
      throw_damaged(path, "/frame", "the origin is not finite, or impossibly far away");
    }
  }
  if (!limits::is_up(frame.level)) {
    throw_damaged(path, "/frame", "the level is no unit vector that points up");
  }
}

std::string version_text(ArtefactType type) {
  return std::to_string(type.major) + "." + std::to_string(type.minor);
}

void check_type_and_version(const std::filesystem::path& path, const std::string& artefact,
                            const std::string& version, ArtefactType expected) {
  if (artefact.empty()) {
    throw StageError(errors::kArtefactDamaged, path.string(),
                     "does not say which artefact it is (expected " + std::string(expected.name) + ")",
                     "was it written by roomcut? If so: " + std::string(kMakeAgain));
  }
  if (artefact != expected.name) {
    throw StageError(errors::kArtefactType, path.string(),
                     "is an artefact of type " + artefact + ", not " + expected.name,
                     "look at the options of this stage");
  }
  int major = 0;
  int minor = 0;
  const char* end = version.data() + version.size();
  const auto [dot, bad_major] = std::from_chars(version.data(), end, major);
  const bool has_minor = bad_major == std::errc() && dot != end && *dot == '.';
  const auto [stop, bad_minor] = has_minor ? std::from_chars(dot + 1, end, minor)
                                           : std::from_chars_result{dot, std::errc::invalid_argument};
  if (bad_minor != std::errc() || stop != end) {
    throw_damaged(path, "", "states no schema version");
  }
  if (major != expected.major || minor > expected.minor) {
    throw StageError(errors::kArtefactVersion, path.string(),
                     artefact + " has schema version " + version + ", this program reads " +
                         version_text(expected) + (expected.minor > 0 ? " and older minor versions" : ""),
                     "make it again with this version of roomcut");
  }
}

}  // namespace roomcut

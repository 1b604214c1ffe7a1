// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/openings/openings_io.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/artefact/atomic_file.h"
#include "common/artefact/frame_crs.h"
#include "common/artefact/json_values.h"
#include "common/artefact/known_artefacts.h"
#include "common/artefact/limits.h"
#include "common/artefact/sha256.h"
#include "common/errors/codes.h"

// The page of this artefact is schemas/openings.md.

namespace roomcut {

namespace {

constexpr const char* kMember = "roomcut";

/// Six decimals whatever the locale.
std::string fixed(double value) {
  if (!std::isfinite(value)) {
    throw std::logic_error("openings: a value is not finite");
  }
  std::array<char, 400> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 6).ptr;
  return {buffer.data(), end};
}

std::string proof_text(const OpeningProof& proof) {
  return R"({"points": )" + std::to_string(proof.points) + R"(, "spread": )" + fixed(proof.spread) +
         R"(, "sigma_m": )" + fixed(proof.sigma_m) + "}";
}

std::string feature_text(const Opening& opening, const Frame& frame) {
  const OpeningPlace place = place_in_scan(opening, frame);
  const std::string id = canonical_json(opening.id);
  return R"({"type": "Feature", "id": )" + id + R"(, "properties": {"opening_id": )" + id + R"(, "walls": )" +
         canonical_json({opening.wall_a, opening.wall_b}) + R"(, "thickness_m": )" +
         fixed(opening.thickness_m) + R"(, "width_m": )" + fixed(opening.width()) + R"(, "sill_z_m": )" +
         fixed(place.sill_z) + R"(, "head_z_m": )" + fixed(place.head_z) + R"(, "jamb_a": )" +
         proof_text(opening.proof_a) + R"(, "jamb_b": )" + proof_text(opening.proof_b) + R"(, "head": )" +
         proof_text(opening.proof_head) + R"(}, "geometry": {"type": "LineString", "coordinates": [[)" +
         fixed(place.jamb_a.x()) + ", " + fixed(place.jamb_a.y()) + "], [" + fixed(place.jamb_b.x()) + ", " +
         fixed(place.jamb_b.y()) + "]]}}";
}

std::string features_text(const Openings& openings) {
  std::string text;
  for (const Opening& opening : openings.openings) {
    text += (text.empty() ? "" : ",\n") + feature_text(opening, openings.frame);
  }
  return text;
}

constexpr double kMostSpread = 1e3;  ///< a share, with room for rounding

OpeningProof proof_from(const Json& value) {
  constexpr std::int64_t kMostPoints = std::numeric_limits<std::uint32_t>::max();
  return {static_cast<std::uint32_t>(whole_number_in(value.at("points"), 0, kMostPoints)),
          number_at(value, "spread", 0, kMostSpread), metres_at(value, "sigma_m")};
}

/// Of a damaged file places may lie anywhere.
void require_near(const Opening& opening) {
  for (const double value : {opening.jamb_a.x(), opening.jamb_a.y(), opening.jamb_b.x(), opening.jamb_b.y(),
                             opening.sill_z, opening.head_z}) {
    if (!limits::is_local(value)) {
      throw BadJson("the opening lies impossibly far from the frame's origin");
    }
  }
}

Opening opening_from(const Json& feature, const Frame& frame) {
  const Json& geometry = feature.at("geometry");
  const Json& properties = feature.at("properties");
  if (geometry.at("type") != "LineString" || geometry.at("coordinates").size() != 2) {
    throw BadJson("the geometry is no LineString of two points");
  }
  const auto point = [&](std::size_t i) {
    const Json& p = geometry.at("coordinates").at(i);
    return Vec2(scan_metres(p.at(0)), scan_metres(p.at(1)));
  };
  Opening opening;
  opening.id = properties.at("opening_id").get<std::string>();
  opening.wall_a = properties.at("walls").at(0).get<std::string>();
  opening.wall_b = properties.at("walls").at(1).get<std::string>();
  opening.thickness_m = metres_at(properties, "thickness_m");
  set_place(
      opening,
      {point(0), point(1), scan_metres(properties.at("sill_z_m")), scan_metres(properties.at("head_z_m"))},
      frame);
  require_near(opening);
  opening.proof_a = proof_from(properties.at("jamb_a"));
  opening.proof_b = proof_from(properties.at("jamb_b"));
  opening.proof_head = proof_from(properties.at("head"));
  if (opening.width() <= 0 || opening.height() <= 0) {
    throw BadJson("the opening has no width or no height");
  }
  return opening;
}

std::vector<Opening> openings_from(const Json& features, const Frame& frame) {
  std::vector<Opening> openings;
  for (std::size_t i = 0; i < features.size(); ++i) {
    try {
      openings.push_back(opening_from(features.at(i), frame));
    } catch (const Json::exception& error) {
      throw BadJson("features[" + std::to_string(i) + "]: " + short_message(error));
    } catch (const BadJson& error) {
      throw BadJson("features[" + std::to_string(i) + "]: " + error.what());
    }
  }
  return openings;
}

std::string payload_of(const Openings& normalised) {
  return sha256_hex(version_text(artefacts::kOpenings) + "\n" + canonical_json(to_json(normalised.frame)) +
                    "\n" + normalised.cells_payload_sha256 + "\n" + features_text(normalised));
}

}  // namespace

OpeningsFile read_openings(const std::filesystem::path& path) {
  OpeningsFile file;
  std::string stated;
  std::string version;
  try {
    const Json document = parse_json(read_text_file(path));
    const Json& member = document.at(kMember);
    version = member.at("schema_version").get<std::string>();
    check_type_and_version(path, member.at("artefact").get<std::string>(), version, artefacts::kOpenings);
    file.content.frame = frame_from_json(member.at("frame"));
    file.content.cells_payload_sha256 = member.at("cells_payload_sha256").get<std::string>();
    file.content.openings = openings_from(document.at("features"), file.content.frame);
    stated = member.at("provenance").at("payload_sha256").get<std::string>();
  } catch (const Json::exception& error) {
    throw_damaged(path, "", "not an openings artefact: " + short_message(error));
  } catch (const BadJson& error) {
    throw_damaged(path, "", error.what());
  }
  file.payload_sha256 = payload_of(normalised_openings(file.content));
  require_payload(path, stated, file.payload_sha256);
  remember_artefact(path, {"", artefacts::kOpenings.name, version, stated, ""});
  return file;
}

OpeningsFile read_openings(const std::filesystem::path& path, const std::string& cells_payload_sha256) {
  OpeningsFile file = read_openings(path);
  if (file.content.cells_payload_sha256 != cells_payload_sha256) {
    throw StageError(errors::kArtefactMismatch, path.string(), "these openings were found in other cells",
                     "rerun find_openings");
  }
  return file;
}

std::string openings_text(const Openings& openings, const Provenance& provenance) {
  const Openings normalised = normalised_openings(openings);
  Json made = to_json(provenance);
  made["payload_sha256"] = payload_of(normalised);
  return std::string("{\n\"type\": \"FeatureCollection\",\n\"name\": \"openings\",\n") +
         "\"crs\": {\"type\": \"name\", \"properties\": {\"name\": " +
         canonical_json(crs_of(normalised.frame)) + "}},\n\"" + kMember +
         "\": {\n\"artefact\": \"openings\",\n\"schema_version\": " +
         canonical_json(version_text(artefacts::kOpenings)) +
         ",\n\"length_unit\": \"m\",\n\"coordinates\": \"scan\",\n\"frame\": " +
         canonical_json(to_json(normalised.frame)) +
         ",\n\"cells_payload_sha256\": " + canonical_json(normalised.cells_payload_sha256) +
         ",\n\"provenance\": " + canonical_json(made) + "\n},\n\"features\": [\n" +
         features_text(normalised) + "\n]\n}\n";
}

bool write_openings(const std::filesystem::path& path, const Openings& openings,
                    const Provenance& provenance) {
  return publish_json(path, openings_text(openings, provenance), payload_of(normalised_openings(openings)));
}

}  // namespace roomcut

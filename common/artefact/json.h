// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "common/artefact/provenance.h"
#include "common/artefact/types.h"

namespace roomcut {

using Json = nlohmann::json;

/// Compact text with sorted keys; equal values give equal text. Throws std::logic_error for NaN or infinity,
/// which JSON cannot hold and nlohmann would silently turn into null.
std::string canonical_json(const Json& value);
/// Readable text (indent 2, sorted keys) with the same check.
std::string pretty_json(const Json& value);

Json to_json(const Provenance& provenance);
Json to_json(const Frame& frame);
/// Throws nlohmann::json::exception when members are missing.
Provenance provenance_from_json(const Json& value);
Frame frame_from_json(const Json& value);

/// Publishes a JSON artefact `text`, whose payload (all but provenance) has digest `payload_sha256`: beside,
/// fsync, rename; the old modification time is kept when the file that stands there has the same payload
/// digest. Returns whether the payload is new.
bool publish_json(const std::filesystem::path& path, const std::string& text,
                  const std::string& payload_sha256);

/// Makes and publishes a plain JSON artefact (summary, scores …): `payload` plus members artefact,
/// schema_version, frame and provenance.
bool write_json_artefact(const std::filesystem::path& path, ArtefactType type, const Provenance& provenance,
                         const Frame& frame, Json payload);

/// Reads and checks type and version. Errors as H5Reader.
Json read_json_artefact(const std::filesystem::path& path, ArtefactType expected);

}  // namespace roomcut

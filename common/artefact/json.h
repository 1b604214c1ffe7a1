// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>

#include "common/artefact/provenance.h"
#include "common/artefact/types.h"

namespace roomcut {

using Json = nlohmann::json;  ///< only declared here: json_values.h

/// Arrays and objects within each other, at most; what is nested deeper is refused, as walking it would use
/// up the stack. No file of ours has ten.
inline constexpr int kDeepestJson = 64;

/// A text that is not JSON, or holds what a program cannot: nested deeper than kDeepestJson, a number beyond
/// double. what() is for people: "parse error at line 3, column 5: …".
class BadJson : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The one parser of texts from files: throws BadJson; all numbers of the result are finite, all texts UTF-8.
Json parse_json(const std::string& text);
/// The same with null for what is not JSON.
Json try_parse_json(const std::string& text);
/// Throws BadJson when `text` is nested too deeply; for those who parse it themselves.
void check_json_depth(const std::string& text);

/// The value for a message: its first letters.
std::string excerpt(const Json& value);

/// Whether JSON can hold the text.
bool is_utf8(const std::string& text);

/// A number in [low, high], a whole one in [low, high]; throw BadJson otherwise.
double number_in(const Json& value, double low, double high);
std::int64_t whole_number_in(const Json& value, std::int64_t low, std::int64_t high);
/// A coordinate, height or length [m]: number_in() the limits of limits.h.
double local_metres(const Json& value);
/// The same of a coordinate in the scan's own, which may lie as far as a frame's origin.
double scan_metres(const Json& value);
/// The same for the member `key` of an object; the message names it. Throw nlohmann::json::exception when
/// there is none.
double number_at(const Json& owner, const char* key, double low, double high);
double metres_at(const Json& owner, const char* key);

/// Compact text with sorted keys; equal values give equal text. Throws std::logic_error for NaN or infinity,
/// which JSON cannot hold and nlohmann would silently turn into null.
std::string canonical_json(const Json& value);
/// Compact text for people and pages: NaN and infinity are null, bytes that are no UTF-8 become U+FFFD.
std::string lossy_json(const Json& value);
/// Readable text (indent 2, sorted keys) with the same check.
std::string pretty_json(const Json& value);

Json to_json(const Provenance& provenance);
Json to_json(const Frame& frame);
/// Throw nlohmann::json::exception when members are missing or of another type, BadJson when numbers are
/// impossible.
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

/// Reads, checks type and version and compares the content with the digest that the file states. Errors as
/// H5Reader.
Json read_json_artefact(const std::filesystem::path& path, ArtefactType expected);

}  // namespace roomcut

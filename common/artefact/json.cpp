// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/json.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/artefact/atomic_file.h"
#include "common/artefact/h5.h"
#include "common/artefact/json_values.h"
#include "common/artefact/limits.h"
#include "common/artefact/sha256.h"
#include "common/errors/codes.h"

namespace roomcut {

namespace {

void require_finite(const Json& value, const std::string& path) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    throw std::logic_error("JSON cannot hold the value of " + (path.empty() ? "/" : path));
  }
  if (value.is_structured()) {
    for (const auto& item : value.items()) {
      require_finite(item.value(), path + "/" + item.key());
    }
  }
}

/// Digest of everything but the provenance.
std::string payload_of(Json value) {
  value.erase("provenance");
  return sha256_hex(canonical_json(value));
}

}  // namespace

std::string short_message(const Json::exception& error) {
  const std::string message = error.what();
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

void check_json_depth(const std::string& text) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text) {
      i += c == '\\' ? 1 : 0;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestJson) {
        throw BadJson("nested deeper than " + std::to_string(kDeepestJson) + " levels at byte " +
                      std::to_string(i));
      }
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

Json parse_json(const std::string& text) {
  check_json_depth(text);
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw BadJson(short_message(error));
  }
}

Json try_parse_json(const std::string& text) {
  try {
    return parse_json(text);
  } catch (const BadJson&) {
    return {};
  }
}

bool is_utf8(const std::string& text) {
  try {
    return !Json(text).dump().empty();
  } catch (const Json::type_error&) {
    return false;
  }
}

std::string excerpt(const Json& value) {
  constexpr std::size_t kLongest = 60;
  const std::string text = value.dump(-1, ' ', true);  // ASCII: may be cut anywhere
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + " …";
}

double number_in(const Json& value, double low, double high) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= low && number <= high)) {
    throw BadJson("is " + excerpt(value) + ", must be a number from " + Json(low).dump() + " to " +
                  Json(high).dump());
  }
  return number;
}

std::int64_t whole_number_in(const Json& value, std::int64_t low, std::int64_t high) {
  const bool fits =
      value.is_number_integer() &&
      (!value.is_number_unsigned() ||
       value.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()));
  const std::int64_t number = fits ? value.get<std::int64_t>() : 0;
  if (!fits || number < low || number > high) {
    throw BadJson("is " + excerpt(value) + ", must be a whole number from " + std::to_string(low) + " to " +
                  std::to_string(high));
  }
  return number;
}

double local_metres(const Json& value) {
  return number_in(value, -limits::kFarthest_m, limits::kFarthest_m);
}

double scan_metres(const Json& value) {
  return number_in(value, -limits::kFarthestOrigin_m, limits::kFarthestOrigin_m);
}

double number_at(const Json& owner, const char* key, double low, double high) {
  const Json& value = owner.at(key);
  try {
    return number_in(value, low, high);
  } catch (const BadJson& trouble) {
    throw BadJson(std::string(key) + " " + trouble.what());
  }
}

double metres_at(const Json& owner, const char* key) {
  return number_at(owner, key, -limits::kFarthest_m, limits::kFarthest_m);
}

std::string canonical_json(const Json& value) {
  require_finite(value, "");
  return value.dump();
}

std::string lossy_json(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string pretty_json(const Json& value) {
  require_finite(value, "");
  return value.dump(2);
}

Json to_json(const Provenance& provenance) {
  Json inputs = Json::array();
  for (const InputRecord& input : provenance.inputs) {
    inputs.push_back({{"name", input.name},
                      {"artefact", input.artefact},
                      {"schema_version", input.schema_version},
                      {"payload_sha256", input.payload_sha256},
                      {"path", input.path}});
  }
  return {{"stage", provenance.stage},
          {"stage_revision", provenance.stage_revision},
          {"params_json", provenance.params_json},
          {"params_sha256", provenance.params_sha256},
          {"inputs", inputs}};
}

Json to_json(const Frame& frame) {
  Json value = {{"origin", {frame.origin[0], frame.origin[1], frame.origin[2]}},
                {"unit", frame.unit},
                {"up", frame.up}};
  if (frame.levelled()) {
    value["level"] = {frame.level[0], frame.level[1], frame.level[2]};
  }
  if (!frame.crs.empty()) {
    value["crs"] = frame.crs;
  }
  return value;
}

Provenance provenance_from_json(const Json& value) {
  Provenance provenance;
  provenance.stage = value.at("stage").get<std::string>();
  provenance.stage_revision = static_cast<int>(whole_number_in(value.at("stage_revision"), 0, 1'000'000'000));
  provenance.params_json = value.at("params_json").get<std::string>();
  provenance.params_sha256 = value.at("params_sha256").get<std::string>();
  for (const Json& input : value.at("inputs")) {
    provenance.inputs.push_back({input.at("name").get<std::string>(), input.at("artefact").get<std::string>(),
                                 input.at("schema_version").get<std::string>(),
                                 input.at("payload_sha256").get<std::string>(),
                                 input.at("path").get<std::string>()});
  }
  return provenance;
}

Frame frame_from_json(const Json& value) {
  Frame frame;
  for (std::size_t i = 0; i < 3; ++i) {
    frame.origin[i] = scan_metres(value.at("origin").at(i));
  }
  frame.unit = value.at("unit").get<std::string>();
  frame.up = value.at("up").get<std::string>();
  for (std::size_t i = 0; i < 3 && value.contains("level"); ++i) {
    frame.level[i] = number_in(value.at("level").at(i), -1, 1);
  }
  if (!limits::is_up(frame.level)) {
    throw BadJson("level is no unit vector that points up");
  }
  frame.crs = value.value("crs", std::string());
  return frame;
}

std::string json_payload_sha256(const std::string& text) {
  const Json value = try_parse_json(text);
  return value.is_object() ? payload_of(value) : std::string();
}

bool publish_json(const std::filesystem::path& path, const std::string& text,
                  const std::string& payload_sha256) {
  const bool same = stated_payload(path) == payload_sha256 && !payload_sha256.empty();
  if (same && read_text_file(path) == text) {
    return false;
  }
  AtomicFile file(path);
  file.write(text);
  file.commit(same);
  return !same;
}

bool write_json_artefact(const std::filesystem::path& path, ArtefactType type, const Provenance& provenance,
                         const Frame& frame, Json payload) {
  payload["artefact"] = type.name;
  payload["schema_version"] = version_text(type);
  payload["frame"] = to_json(frame);
  const std::string digest = payload_of(payload);
  payload["provenance"] = to_json(provenance);
  payload["provenance"]["payload_sha256"] = digest;
  return publish_json(path, pretty_json(payload) + "\n", digest);
}

Json read_json_artefact(const std::filesystem::path& path, ArtefactType expected) {
  const std::string text = read_text_file(path);
  Json value;
  try {
    value = parse_json(text);
  } catch (const BadJson& error) {
    throw_damaged(path, "", std::string("not JSON: ") + error.what());
  }
  const auto word = [](const Json& owner, const char* key) {
    return owner.is_object() && owner.contains(key) && owner[key].is_string() ? owner[key].get<std::string>()
                                                                              : std::string();
  };
  check_type_and_version(path, word(value, "artefact"), word(value, "schema_version"), expected);
  const Json provenance = value.value("provenance", Json());
  require_payload(path, word(provenance, "payload_sha256"), payload_of(value));
  return value;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/json.h"

#include <cmath>
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/artefact/atomic_file.h"
#include "common/artefact/h5.h"
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

std::string canonical_json(const Json& value) {
  require_finite(value, "");
  return value.dump();
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
  return value;
}

Provenance provenance_from_json(const Json& value) {
  Provenance provenance;
  provenance.stage = value.at("stage").get<std::string>();
  provenance.stage_revision = value.at("stage_revision").get<int>();
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
    frame.origin[i] = value.at("origin").at(i).get<double>();
  }
  frame.unit = value.at("unit").get<std::string>();
  frame.up = value.at("up").get<std::string>();
  for (std::size_t i = 0; i < 3 && value.contains("level"); ++i) {
    frame.level[i] = value.at("level").at(i).get<double>();
  }
  return frame;
}

std::string json_payload_sha256(const std::string& text) {
  const Json value = Json::parse(text, nullptr, false);
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
    value = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw StageError(errors::kArtefactDamaged, path.string(), std::string("not JSON: ") + error.what(),
                     "make it again with the stage that writes it");
  }
  const auto word = [&value](const char* key) {
    return value.is_object() && value.contains(key) && value[key].is_string() ? value[key].get<std::string>()
                                                                              : std::string();
  };
  check_type_and_version(path, word("artefact"), word("schema_version"), expected);
  return value;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <stdexcept>

#include "common/artefact/h5.h"
#include "common/artefact/sha256.h"
#include "common/cli/messages.h"
#include "common/cli/stage_state.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

const StageFile* find_file(const std::vector<StageFile>& files, const std::string& name) {
  for (const StageFile& file : files) {
    if (file.name == name) {
      return &file;
    }
  }
  return nullptr;
}

const StageFile& declared(const std::vector<StageFile>& files, const std::string& name) {
  const StageFile* file = find_file(files, name);
  if (file == nullptr) {
    throw std::logic_error("the stage declares no file " + name);
  }
  return *file;
}

/// As provenance names a file: below the work folder relative to the artefact, so that the folder may move; a
/// file of the user (no default path) by its name alone, since where it lies says nothing about the result.
std::string recorded_path(const StageFile& input, const fs::path& path, const fs::path& first_output) {
  if (input.default_path.empty()) {
    return path.filename().string();
  }
  const fs::path folder = fs::absolute(first_output).lexically_normal().parent_path();
  return fs::absolute(path).lexically_normal().lexically_proximate(folder).generic_string();
}

}  // namespace

fs::path StageRun::input(const std::string& name) const {
  declared(state_.info->inputs, name);
  return state_.files.at(name);
}

bool StageRun::has_input(const std::string& name) const {
  declared(state_.info->inputs, name);
  std::error_code error;
  return fs::exists(state_.files.at(name), error);
}

fs::path StageRun::output(const std::string& name) const {
  declared(state_.info->outputs, name);
  return state_.files.at(name);
}

const std::string& StageRun::option(const std::string& name) const {
  return state_.options.at(name);
}
int StageRun::threads() const {
  return state_.threads;
}
bool StageRun::quiet() const {
  return state_.quiet;
}

const Provenance& StageRun::provenance() const {
  if (state_.provenance) {
    return *state_.provenance;
  }
  const StageInfo& info = *state_.info;
  Provenance provenance{info.name, info.revision, state_.params_json, sha256_hex(state_.params_json), {}};
  const fs::path first_output =
      info.outputs.empty() ? fs::path("x") : state_.files.at(info.outputs.front().name);
  for (const StageFile& file : info.inputs) {
    if (file.optional && !has_input(file.name)) {
      continue;
    }
    const fs::path& path = state_.files.at(file.name);
    const auto digest = state_.given_digests.find(file.name);
    InputRecord record;
    if (digest != state_.given_digests.end() || file.by_bytes) {
      record.payload_sha256 = digest != state_.given_digests.end() ? digest->second : sha256_of_file(path);
    } else {
      record = inspect_artefact(path);
    }
    if (record.artefact.empty()) {
      record.artefact = file.name;
    }
    record.name = file.name;
    record.path = recorded_path(file, path, first_output);
    provenance.inputs.push_back(std::move(record));
  }
  state_.provenance = std::move(provenance);
  return *state_.provenance;
}

void StageRun::set_input_digest(const std::string& name, const std::string& sha256) {
  declared(state_.info->inputs, name);
  state_.given_digests[name] = sha256;
  state_.provenance.reset();
}

void StageRun::wrote(const fs::path& path) {
  state_.also_written.push_back(path);
}

Progress StageRun::progress(const std::string& what, std::uint64_t total) const {
  return {state_.info->name + ": " + what, total, state_.quiet};
}

void StageRun::chose(const std::string& parameter, double value) {
  const auto found = std::find_if(state_.table->begin(), state_.table->end(),
                                  [&](const Parameter& p) { return p.name == parameter; });
  if (found == state_.table->end()) {
    throw std::logic_error("the stage has no parameter " + parameter);
  }
  const std::string& why = found->formula;
  const std::scoped_lock lock(state_.mutex);
  state_.choices.push_back({parameter, value, why});
  messages::info(state_.info->name + ": " + parameter + " = " + messages::readable(value) + " (" + why + ")");
}

void StageRun::count(const std::string& what, double value, const std::string& unit) {
  const std::scoped_lock lock(state_.mutex);
  state_.counts.push_back({what, value, unit});
}

void StageRun::note(const std::string& text) {
  const std::scoped_lock lock(state_.mutex);
  state_.notes.push_back(text);
  messages::info(state_.info->name + ": " + text);
}

void StageRun::warn(const std::string& text) {
  const std::scoped_lock lock(state_.mutex);
  state_.warnings.push_back(text);
  messages::warn("warning: " + state_.info->name + ": " + text);
}

}  // namespace roomcut

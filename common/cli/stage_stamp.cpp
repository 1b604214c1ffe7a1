// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/stage_stamp.h"

#include <sstream>

#include "common/artefact/h5.h"
#include "common/rerun/stamp.h"
#include "common/rerun/work_digests.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

/// As the file states it: it was written in this run of the pipeline, or found right before it.
std::string stated_digest(const fs::path& path) {
  return inspect_artefact(path).payload_sha256;
}

/// Of an input that another stage makes.
std::string made_digest(const std::string& name) {
  return file_state(name) ? stated_digest(name) : kNoFile;
}

}  // namespace

StageStamp::StageStamp(fs::path stamp, const std::string& reads) : stamp_(std::move(stamp)) {
  std::istringstream words(reads);
  for (std::string word; words >> word;) {
    reads_.push_back(word);
  }
}

bool StageStamp::is_current() const {
  const StampFile file = read_stamp(stamp_);
  WorkDigests digests(stated_digest);
  const auto digest_of = [&](const std::string& name) {
    return is_from_outside(name) ? digests.of(name) : made_digest(name);
  };
  return file.state == StampState::kWhole && changed_inputs(file.stamp, reads_, digest_of).empty();
}

void StageStamp::begin(const fs::path& scan) {
  begun_ = file_system_now(stamp_.parent_path());
  WorkDigests digests(stated_digest);
  for (const std::string& name : reads_) {
    if (name == kScanName) {
      scan_state_ = file_state(scan);  // its digest is the stage's own affair: it reads the bytes anyway
    } else if (is_from_outside(name)) {
      from_outside_[name] = digests.of(name);
    }
  }
  withdraw_stamp(stamp_);
}

std::string StageStamp::input_digest(const std::string& name, const StageRun& run) const {
  const auto outside = from_outside_.find(name);
  if (outside != from_outside_.end()) {
    return outside->second;
  }
  if (name == kScanName) {
    for (const InputRecord& input : run.provenance().inputs) {
      if (input.name == name) {
        return input.payload_sha256;
      }
    }
  }
  return made_digest(name);
}

void StageStamp::settle(const StageRun& run, const std::vector<fs::path>& outputs) const {
  Stamp stamp;
  for (const std::string& name : reads_) {
    stamp.inputs.push_back({input_digest(name, run), name, ""});
    if (name == kScanName && scan_state_ && begun_) {
      append_digest(name, *scan_state_, *begun_, stamp.inputs.back().sha256);
    }
  }
  const std::optional<FileSystemNow> now = file_system_now(stamp_.parent_path());
  for (const fs::path& output : outputs) {
    const InputRecord stated = inspect_artefact(output);
    // What is no artefact states the digest of its bytes.
    const std::string content =
        stated.artefact.empty() ? stated.payload_sha256 : content_digest(output, stated_digest);
    stamp.outputs.push_back({stated.payload_sha256, output.generic_string(), content});
    const std::optional<FileState> state = file_state(output);
    if (now && state) {
      append_digest(stamp.outputs.back().name, *state, *now, content);
    }
  }
  settle_stamp(stamp_, stamp);
}

}  // namespace roomcut

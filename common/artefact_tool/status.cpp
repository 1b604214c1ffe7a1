// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact_tool/status.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "common/artefact/h5.h"
#include "common/artefact/json_values.h"
#include "common/errors/error.h"
#include "common/rerun/work_digests.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

bool is_edit(const std::string& file) {
  return file.starts_with("edits/");
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// A JSON file; null when it is missing or none.
Json json_or_null(const fs::path& path) {
  return is_there(path) ? try_parse_json(read_text_file(path)) : Json(nullptr);
}

std::string joined(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (const std::string& part : parts) {
    text += (text.empty() ? "" : between) + part;
  }
  return text;
}

/// What changed in params/<program>.json since the last run, as its log tells.
std::vector<std::string> parameter_changes(const PipelineStage& stage, const std::string& file) {
  const Json log = json_or_null("logs/" + stage.name + ".json");
  const Json now = json_or_null(file);
  if (!log.is_object() || !now.is_object() || !log.contains("params") || !now.contains("params")) {
    return {"its parameters changed"};
  }
  std::vector<std::string> text =
      describe_parameters(canonical_json(log["params"]), canonical_json(now["params"]));
  const int before = log.value("revision", 0);
  const int after = now.value("revision", 0);
  if (before != after) {
    text.push_back("the program changed (revision " + std::to_string(before) + " -> " +
                   std::to_string(after) + ")");
  }
  if (text.empty()) {
    text.emplace_back("its parameters are others than it ran with");
  }
  return text;
}

bool was_made_with_edit(const PipelineStage& stage) {
  for (const std::string& output : stage.outputs) {
    try {
      for (const InputRecord& input : read_provenance(output).inputs) {
        if (input.name == "edit") {
          return true;
        }
      }
    } catch (const StageError&) {  // missing or damaged: verify says so, status only guesses
      continue;
    }
  }
  return false;
}

std::string edit_change(const PipelineStage& stage, const std::string& edit) {
  const bool had = was_made_with_edit(stage);
  if (had && is_there(edit)) {
    return "the hand edit changed";
  }
  return had ? "the hand edit was dropped" : "a hand edit was put in place";
}

std::vector<std::string> reasons(const PipelineStage& stage, const StaleStage& stale) {
  std::vector<std::string> text;
  for (const std::string& file : stale.missing) {
    text.push_back("its output " + file + " is missing");
  }
  for (const std::string& file : stale.damaged) {
    text.push_back("its output " + file + " was changed or damaged");
  }
  for (const std::string& file : stale.changed) {
    if (file.starts_with("params/")) {
      for (std::string& change : parameter_changes(stage, file)) {
        text.push_back(std::move(change));
      }
    } else if (file == kScanName) {
      text.emplace_back("the scan changed");
    } else if (file == "inputs/scan.options") {
      text.emplace_back("the scan is to be read with another up axis or unit");
    } else if (file == "inputs/stations.txt") {
      text.emplace_back("the scanner positions changed");
    } else if (is_edit(file)) {
      text.push_back(edit_change(stage, file));
    } else {
      text.push_back("its input " + file + " is another than it read");
    }
  }
  return text;
}

std::string stale_text(const PipelineStage& stage, const StaleStage& stale) {
  switch (stale.stamp) {
    case StampState::kNone:
      return "never run";
    case StampState::kUnfinished:
      return "stale: it did not finish last time";
    case StampState::kUnknown:
      return "stale: its stamp does not say what it was made from (of an older roomcut, or cut short)";
    default:
      return "stale: " + joined(reasons(stage, stale), ", ");
  }
}

/// ", edited: 1 moved, 1 locked" for the stage that took in a hand edit; "" for all others.
std::string edit_text(const PipelineStage& stage) {
  const auto edit = std::find_if(stage.inputs.begin(), stage.inputs.end(), is_edit);
  if (edit == stage.inputs.end() || !is_there(*edit)) {
    return "";
  }
  const Json log = json_or_null("logs/" + stage.name + ".json");
  std::vector<std::string> counts;
  if (log.is_object() && log.contains("counts")) {
    for (const Json& count : log["counts"]) {
      const std::string what = count.value("what", "");
      const bool told = what == "moved" || what == "added" || what == "deleted" || what == "locked";
      if (told && count["value"].is_number() && count["value"] != 0) {
        counts.push_back(std::to_string(count["value"].get<long>()) + " " + what);
      }
    }
  }
  return counts.empty() ? ", edited: nothing changed by it" : ", edited: " + joined(counts, ", ");
}

}  // namespace

void print_status(const std::vector<PipelineStage>& pipeline, const std::vector<StaleStage>& stale) {
  const auto waits = waits_for(pipeline, stale);
  std::size_t width = 0;
  for (const PipelineStage& stage : pipeline) {
    width = std::max(width, stage.name.size());
  }
  for (std::size_t i = 0; i < pipeline.size(); ++i) {
    const PipelineStage& stage = pipeline[i];
    const auto found =
        std::find_if(stale.begin(), stale.end(), [&](const StaleStage& s) { return s.name == stage.name; });
    std::string text = "fresh" + edit_text(stage);
    if (found != stale.end()) {
      text = stale_text(stage, *found);
    } else if (!waits[i].empty()) {
      text += ", runs only if " + joined(waits[i], " or ") + " comes out different";
    }
    std::cout << "  " << stage.name << std::string(width - stage.name.size() + 3, ' ') << text << "\n";
  }
  if (stale.empty()) {
    std::cout << "Everything is up to date.\n";
  } else {
    std::cout << "make run does the stages that are not fresh, and of what follows only what they change.\n";
  }
}

}  // namespace roomcut

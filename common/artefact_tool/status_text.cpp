// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>
#include <sstream>

#include "common/artefact/json.h"
#include "common/artefact_tool/status.h"

namespace roomcut {

std::vector<PipelineStage> parse_pipeline(const std::string& text) {
  std::vector<PipelineStage> pipeline;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    PipelineStage stage;
    if (!(words >> stage.name >> stage.program)) {
      continue;
    }
    int part = 0;  // the colons passed
    for (std::string word; words >> word;) {
      if (word == ":") {
        ++part;
      } else {
        (part == 1 ? stage.outputs : stage.inputs).push_back(word);
      }
    }
    pipeline.push_back(std::move(stage));
  }
  return pipeline;
}

std::vector<StaleStage> parse_stale(const std::string& text) {
  constexpr std::string_view kMissing = "missing:";
  std::vector<StaleStage> stale;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    StaleStage stage;
    if (!(words >> stage.name)) {
      continue;
    }
    for (std::string word; words >> word;) {
      if (word.starts_with(kMissing)) {
        stage.missing.push_back(word.substr(kMissing.size()));
      } else {
        stage.changed.push_back(word);
      }
    }
    stale.push_back(std::move(stage));
  }
  return stale;
}

std::vector<std::string> describe_parameters(const std::string& before, const std::string& after) {
  const Json old = Json::parse(before, nullptr, false);
  const Json now = Json::parse(after, nullptr, false);
  std::vector<std::string> text;
  if (!old.is_object() || !now.is_object()) {
    return text;
  }
  const auto word = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  for (const auto& [key, value] : now.items()) {
    if (!old.contains(key)) {
      text.push_back("parameter " + key + " is new (" + word(value) + ")");
    } else if (old[key] != value) {
      text.push_back("parameter " + key + " changed " + word(old[key]) + " -> " + word(value));
    }
  }
  for (const auto& [key, value] : old.items()) {
    if (!now.contains(key)) {
      text.push_back("parameter " + key + " is gone");
    }
  }
  return text;
}

std::vector<std::vector<std::string>> waits_for(const std::vector<PipelineStage>& pipeline,
                                                const std::vector<StaleStage>& stale) {
  std::vector<std::vector<std::string>> result(pipeline.size());
  const auto is_stale = [&](const std::string& name) {
    return std::any_of(stale.begin(), stale.end(), [&](const StaleStage& s) { return s.name == name; });
  };
  for (std::size_t i = 0; i < pipeline.size(); ++i) {
    std::vector<std::string> nearest;
    for (std::size_t k = 0; k < i; ++k) {  // makers of what it reads, in the order of the pipeline
      const auto& outputs = pipeline[k].outputs;
      const bool makes = std::any_of(outputs.begin(), outputs.end(), [&](const std::string& file) {
        return std::find(pipeline[i].inputs.begin(), pipeline[i].inputs.end(), file) !=
               pipeline[i].inputs.end();
      });
      if (!makes) {
        continue;
      }
      const auto& from = is_stale(pipeline[k].name) ? std::vector<std::string>{pipeline[k].name} : result[k];
      for (const std::string& name : from) {
        if (std::find(nearest.begin(), nearest.end(), name) == nearest.end()) {
          nearest.push_back(name);
        }
      }
    }
    result[i] = std::move(nearest);
  }
  return result;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact_tool/rerun_plan.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "common/rerun/work_digests.h"

namespace roomcut {

namespace {

using Names = std::set<std::string>;

bool reads_any(const PipelineStage& stage, const Names& files) {
  return std::any_of(stage.inputs.begin(), stage.inputs.end(),
                     [&](const std::string& file) { return files.contains(file); });
}

/// The outputs of the table and what else the stage said that it wrote.
std::vector<std::string> all_outputs(const PipelineStage& stage, const Stamp& stamp) {
  std::vector<std::string> names = stage.outputs;
  for (const StampEntry& entry : stamp.outputs) {
    if (std::find(names.begin(), names.end(), entry.name) == names.end()) {
      names.push_back(entry.name);
    }
  }
  return names;
}

void look_at_outputs(const PipelineStage& stage, const Stamp& stamp, const DigestOf& content_of,
                     StaleStage& found) {
  for (const std::string& name : all_outputs(stage, stamp)) {
    const auto entry = std::find_if(stamp.outputs.begin(), stamp.outputs.end(),
                                    [&](const StampEntry& e) { return e.name == name; });
    const std::string now = content_of(name);
    if (now == kNoFile) {
      found.missing.push_back(name);
    } else if (entry == stamp.outputs.end() || entry->content != now) {
      found.damaged.push_back(name);
    }
  }
}

/// What is known of the pipeline's files while it is gone through.
struct Known {
  Names to_be_made;                         ///< by stale stages, or by those that wait for one
  std::map<std::string, std::string> made;  ///< payload digests of what lies there and is as it was written
};

StaleStage look_at(const PipelineStage& stage, const Stamp& stamp, const DigestOf& content_of,
                   const Known& known) {
  StaleStage found;
  std::vector<std::string> settled;
  std::copy_if(stage.inputs.begin(), stage.inputs.end(), std::back_inserter(settled),
               [&](const std::string& name) { return !known.to_be_made.contains(name); });
  found.changed = changed_inputs(stamp, settled, [&](const std::string& name) {
    const auto made = known.made.find(name);
    return made == known.made.end() ? content_of(name) : made->second;
  });
  look_at_outputs(stage, stamp, content_of, found);
  return found;
}

bool must_run(const StaleStage& stage) {
  return stage.stamp != StampState::kWhole || stage.asked_for || !stage.changed.empty() ||
         !stage.missing.empty() || !stage.damaged.empty();
}

}  // namespace

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

std::vector<StaleStage> find_stale(const std::vector<PipelineStage>& pipeline, const DigestOf& content_of,
                                   const std::string& again) {
  std::vector<StaleStage> stale;
  Known known;
  for (const PipelineStage& stage : pipeline) {
    const StampFile file = read_stamp("stamps/" + stage.name);
    StaleStage found;
    if (file.state == StampState::kWhole) {
      found = look_at(stage, file.stamp, content_of, known);
    }
    found.name = stage.name;
    found.stamp = file.state;
    found.asked_for = stage.name == again;
    if (must_run(found) || reads_any(stage, known.to_be_made)) {
      known.to_be_made.insert(stage.outputs.begin(), stage.outputs.end());
    } else {
      for (const StampEntry& entry : file.stamp.outputs) {
        known.made[entry.name] = entry.sha256;
      }
    }
    if (must_run(found)) {
      stale.push_back(std::move(found));
    }
  }
  return stale;
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
      if (!reads_any(pipeline[i], Names(pipeline[k].outputs.begin(), pipeline[k].outputs.end()))) {
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

std::vector<std::string> differently_read(const std::vector<PipelineStage>& pipeline) {
  std::map<std::string, std::string> maker;  // of each file
  std::map<std::string, std::string> made;   // its payload digest, as its maker's stamp has it
  std::vector<std::string> found;
  for (const PipelineStage& stage : pipeline) {
    const Stamp stamp = read_stamp("stamps/" + stage.name).stamp;
    for (const StampEntry& input : stamp.inputs) {
      const auto of = maker.find(input.name);
      if (of != maker.end() && made[input.name] != input.sha256) {
        found.push_back(of->second);
      }
    }
    for (const std::string& output : stage.outputs) {
      maker[output] = stage.name;
    }
    for (const StampEntry& output : stamp.outputs) {
      made[output.name] = output.sha256;
    }
  }
  return found;
}

std::vector<PipelineStage> needed_for(const std::vector<PipelineStage>& pipeline,
                                      const std::vector<std::string>& goals) {
  const bool all = std::find(goals.begin(), goals.end(), "run") != goals.end();
  std::vector<PipelineStage> needed;
  Names read;  // by what is needed
  for (auto stage = pipeline.rbegin(); stage != pipeline.rend(); ++stage) {
    const bool is_goal = all || std::find(goals.begin(), goals.end(), stage->name) != goals.end();
    const bool is_read = std::any_of(stage->outputs.begin(), stage->outputs.end(),
                                     [&](const std::string& file) { return read.contains(file); });
    if (is_goal || is_read) {
      read.insert(stage->inputs.begin(), stage->inputs.end());
      needed.push_back(*stage);
    }
  }
  std::reverse(needed.begin(), needed.end());
  return needed;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "common/params/params.h"
#include "common/pipeline/pipeline_table.h"

namespace roomcut {

namespace {

using Problems = std::vector<Problem>;

std::string at_line(const std::string& file, const YAML::Mark& mark) {
  return mark.line < 0 ? file : file + ":" + std::to_string(mark.line + 1);
}

Parameter* find(ParameterTable& table, const std::string& name) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Parameter& p) { return p.name == name; });
  return found == table.end() ? nullptr : &*found;
}

std::string list_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::string names_of(const ParameterTable& table) {
  std::vector<std::string> names;
  for (const Parameter& p : table) {
    names.push_back(p.name);
  }
  return names.empty() ? "this stage has no parameters" : "the parameters are " + list_of(names);
}

void set_value(Parameter& parameter, const std::string& where, const std::string& text, Problems& problems) {
  try {
    parameter.set(text);
  } catch (const std::invalid_argument& error) {
    problems.push_back({errors::kBadParameter, where, std::string(error.what()) + "; it is \"" + text + "\"",
                        parameter.description + " Default: " + parameter.default_text});
  }
}

void read_block(const YAML::Node& block, const std::string& file, const std::string& stage,
                ParameterTable& table, Problems& problems) {
  if (block.IsNull()) {
    return;
  }
  if (!block.IsMap()) {
    problems.push_back({errors::kBadParameter, at_line(file, block.Mark()) + ": " + stage,
                        "must be a block of `key: value` lines", names_of(table)});
    return;
  }
  std::map<std::string, int> seen;
  for (const auto& entry : block) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    const std::string where = at_line(file, entry.first.Mark()) + ": " + stage + "." + key;
    Parameter* parameter = find(table, key);
    const auto [first, is_new] = seen.emplace(key, entry.first.Mark().line + 1);
    if (parameter == nullptr) {
      problems.push_back({errors::kUnknownParameter, where, "there is no such parameter", names_of(table)});
    } else if (!is_new) {
      problems.push_back({errors::kUnknownParameter, where,
                          "the key stands twice, first in line " + std::to_string(first->second),
                          "keep one of them"});
    } else if (entry.second.IsNull() && entry.second.Scalar().empty()) {
      set_value(*parameter, where, "", problems);
    } else if (!entry.second.IsScalar()) {
      problems.push_back({errors::kBadParameter, where, "must be a single value", parameter->description});
    } else {
      set_value(*parameter, where, entry.second.Scalar(), problems);
    }
  }
}

YAML::Node parse_yaml(const std::filesystem::path& path) {
  std::string text;
  try {
    text = read_text_file(path);
  } catch (const StageError& error) {
    throw StageError(errors::kConfigUnreadable, path.string(), error.problems().front().what,
                     "name the file with CONFIG= or --config, or leave it out to use the defaults");
  }
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw StageError(errors::kConfigUnreadable, at_line(path.string(), error.mark), "not YAML: " + error.msg,
                     "blocks are indented by two spaces, and a colon is followed by a space");
  }
}

}  // namespace

const std::vector<std::string>& known_stages() {
  return pipeline_table().programs();
}

void load_yaml(const std::filesystem::path& path, const std::string& stage, ParameterTable& table) {
  const YAML::Node root = parse_yaml(path);
  const std::string file = path.string();
  if (root.IsNull()) {
    return;
  }
  if (!root.IsMap()) {
    throw StageError(errors::kConfigUnreadable, file, "must hold one block per stage",
                     "the blocks are " + list_of(known_stages()));
  }
  Problems problems;
  std::map<std::string, int> seen;
  for (const auto& entry : root) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    const std::string where = at_line(file, entry.first.Mark()) + ": " + name;
    const auto [first, is_new] = seen.emplace(name, entry.first.Mark().line + 1);
    if (std::find(known_stages().begin(), known_stages().end(), name) == known_stages().end()) {
      problems.push_back({errors::kUnknownParameter, where, "there is no such stage",
                          "the blocks are " + list_of(known_stages())});
    } else if (!is_new) {
      problems.push_back({errors::kUnknownParameter, where,
                          "the block stands twice, first in line " + std::to_string(first->second),
                          "put all parameters of a stage into one block"});
    } else if (name == stage) {
      read_block(entry.second, file, stage, table, problems);
    }
  }
  if (!problems.empty()) {
    throw StageError(std::move(problems));
  }
}

void load_dump(const std::filesystem::path& path, const std::string& stage, ParameterTable& table) {
  const std::string file = path.string();
  std::string text;
  try {
    text = read_text_file(path);
  } catch (const StageError& error) {
    throw StageError(errors::kConfigUnreadable, file, error.problems().front().what);
  }
  const Json root = try_parse_json(text);
  const bool whole = root.is_object() && root.contains("params") && root["params"].is_object() &&
                     root.contains("stage") && root["stage"] == stage;
  if (!whole) {
    throw StageError(errors::kConfigUnreadable, file, "is not what `" + stage + " --dump-params` prints",
                     "delete the file and run make");
  }
  Problems problems;
  std::set<std::string> given;
  for (const auto& [key, value] : root["params"].items()) {
    const std::string where = file + ": " + stage + "." + key;
    Parameter* parameter = find(table, key);
    given.insert(key);
    if (parameter == nullptr) {
      problems.push_back({errors::kUnknownParameter, where, "there is no such parameter", names_of(table)});
    } else {
      set_value(*parameter, where, value.is_string() ? value.get<std::string>() : canonical_json(value),
                problems);
    }
  }
  for (const Parameter& parameter : table) {
    if (!given.contains(parameter.name)) {
      problems.push_back({errors::kBadParameter, file + ": " + stage + "." + parameter.name, "is missing",
                          "delete the file and run make"});
    }
  }
  if (!problems.empty()) {
    throw StageError(std::move(problems));
  }
}

void set_parameter(const std::string& assignment, const std::string& stage, ParameterTable& table) {
  const std::string where = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw StageError(errors::kUsage, where, "must be key=value", "for example --set " + stage + ".key=1");
  }
  std::string key = assignment.substr(0, equals);
  if (key.starts_with(stage + ".")) {
    key.erase(0, stage.size() + 1);
  }
  Parameter* parameter = find(table, key);
  if (parameter == nullptr) {
    throw StageError(errors::kUnknownParameter, where, "there is no such parameter", names_of(table));
  }
  Problems problems;
  set_value(*parameter, where, assignment.substr(equals + 1), problems);
  if (!problems.empty()) {
    throw StageError(std::move(problems));
  }
}

std::string params_json(const ParameterTable& table) {
  // Assembled from the parameters' own text: a number stands as it was written, never reformatted.
  std::map<std::string, std::string> sorted;
  for (const Parameter& p : table) {
    sorted[p.name] = p.get();
  }
  std::string text = "{";
  for (const auto& [key, value] : sorted) {
    text += (text.size() > 1 ? ",\"" : "\"") + key + "\":" + value;
  }
  return text + "}";
}

std::string dump_params(const std::string& stage, int revision, const ParameterTable& table) {
  return "{\"params\":" + params_json(table) + ",\"revision\":" + std::to_string(revision) + ",\"stage\":\"" +
         stage + "\"}\n";
}

std::string parameter_help(const ParameterTable& table) {
  std::string text;
  for (const Parameter& p : table) {
    const std::string unit = p.unit == "1" ? "" : " " + p.unit;
    text += "  " + p.name + ": " + p.default_text + "   (" + p.range + unit +
            (p.may_be_auto ? ", or auto: " + p.formula : "") + ")\n      " + p.description + "\n";
  }
  return text;
}

std::string parameter_yaml(const std::string& stage, const std::string& summary,
                           const ParameterTable& table) {
  constexpr std::size_t kWidth = 120;
  std::string text = "# " + summary + "\n" + stage + ":" + (table.empty() ? "  # no parameters" : "") + "\n";
  for (const Parameter& p : table) {
    std::string comment = p.description;
    while (!comment.empty() && comment.back() == '.') {
      comment.pop_back();
    }
    const std::string unit = p.unit == "1" ? "" : " " + p.unit;
    std::istringstream words(comment + " [" + p.range + unit +
                             (p.may_be_auto ? ", or auto: " + p.formula : "") + "]");
    std::string line = "  #";
    for (std::string word; words >> word;) {
      if (line.size() + 1 + word.size() > kWidth) {
        text += line + "\n";
        line = "  #";
      }
      line += " " + word;
    }
    std::string value = p.get();
    std::erase(value, '"');
    text += line + "\n  " + p.name + ": " + value + "\n";
  }
  return text;
}

}  // namespace roomcut

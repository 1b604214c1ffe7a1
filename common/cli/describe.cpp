// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/describe.h"

#include "common/artefact/json_values.h"

namespace roomcut {

namespace {

Json files_json(const std::vector<StageFile>& files) {
  Json list = Json::array();
  for (const StageFile& file : files) {
    list.push_back({{"option", file.name},
                    {"default", file.default_path},
                    {"optional", file.optional},
                    {"description", file.description}});
  }
  return list;
}

Json parameter_json_of(const Parameter& p) {
  Json value = try_parse_json(p.default_text);
  if (value.is_discarded() || value.is_null()) value = p.default_text;  // a word
  Json described = {{"name", p.name},   {"type", p.type},        {"unit", p.unit},
                    {"default", value}, {"auto", p.may_be_auto}, {"description", p.description}};
  if (p.type == "number" || p.type == "integer") {
    described["lowest"] = p.lowest;
    described["highest"] = p.highest;
  }
  if (!p.choices.empty()) {
    described["choices"] = p.choices;
  }
  if (!p.formula.empty()) {
    described["formula"] = p.formula;
  }
  return described;
}

}  // namespace

std::string describe_program(const StageInfo& info, const ParameterTable& table) {
  Json options = Json::array();
  for (const StageOption& option : info.options) {
    options.push_back({{"option", option.name},
                       {"default", option.default_value},
                       {"choices", option.choices},
                       {"description", option.description}});
  }
  Json parameters = Json::array();
  for (const Parameter& p : table) {
    parameters.push_back(parameter_json_of(p));
  }
  return pretty_json({{"name", info.name},
                      {"revision", info.revision},
                      {"summary", info.summary},
                      {"inputs", files_json(info.inputs)},
                      {"outputs", files_json(info.outputs)},
                      {"options", options},
                      {"parameters", parameters}});
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace roomcut {

/// One parameter of a stage, declared once: the YAML reader, `--set`, `--help`, `--dump-params`, the schema
/// of pipeline.yaml and the tables of the docs all come from it. Make them with the functions below.
struct Parameter {
  std::string name;          ///< key inside the stage's block, e.g. "mu_m"
  std::string unit;          ///< "m", "deg", "1" … as the user writes it
  std::string type;          ///< "number", "integer", "boolean", "choice"
  std::string range;         ///< readable, e.g. "0.001 … 0.1"
  std::string default_text;  ///< as in pipeline.yaml, e.g. "auto"
  std::string description;   ///< one sentence
  std::vector<std::string> choices;
  double lowest = 0, highest = 0;  ///< for numbers and integers, in the user's unit
  bool may_be_auto = false;
  std::string formula;  ///< what `auto` comes to, e.g. "3.5 x noise, 2 ... 6 cm"
  /// Sets the bound field from text as it stands in YAML; throws std::invalid_argument("must be …") when it
  /// does not fit.
  std::function<void(const std::string&)> set;
  /// The current value as JSON text: a number, true/false, "word" or "auto".
  std::function<std::string()> get;
};

/// Binds the field's current value as the default. Ranges are closed; NaN and infinity never pass.
Parameter number(std::string name, double& field, std::string unit, double lowest, double highest,
                 std::string description);
/// Like number(), but in `pipeline.yaml` in degrees and in `field` in radians.
Parameter angle(std::string name, double& field_rad, double lowest_deg, double highest_deg,
                std::string description);
/// Empty field = "auto": the stage derives the value from the data by `formula` and says what it chose.
Parameter auto_number(std::string name, std::optional<double>& field, std::string unit, double lowest,
                      double highest, std::string description, std::string formula);
Parameter integer(std::string name, int& field, std::string unit, int lowest, int highest,
                  std::string description);
Parameter boolean(std::string name, bool& field, std::string description);
Parameter choice(std::string name, std::string& field, std::vector<std::string> choices,
                 std::string description);

/// The parameters of one stage, bound to the fields of one params struct.
using ParameterTable = std::vector<Parameter>;

/// Sets the fields from the block `stage` of a pipeline.yaml; parameters that are not named keep their
/// default. Unknown keys (also unknown stages at the top), repeated keys and bad values are all listed, with
/// line numbers. Errors: kConfigUnreadable, kUnknownParameter, kBadParameter.
void load_yaml(const std::filesystem::path& path, const std::string& stage, ParameterTable& table);
/// Sets the fields from a file written by dump_params(). Errors as load_yaml().
void load_dump(const std::filesystem::path& path, const std::string& stage, ParameterTable& table);
/// Applies one `key=value` (or `stage.key=value`).
void set_parameter(const std::string& assignment, const std::string& stage, ParameterTable& table);

/// Canonical JSON of the resolved parameters, without line break: {"key":value,…}.
std::string params_json(const ParameterTable& table);
/// What `--dump-params` prints: {"params":{…},"revision":N,"stage":"name"} and a line break.
std::string dump_params(const std::string& stage, int revision, const ParameterTable& table);
/// The table of `--help` and of the stage's README: name, default, unit, range, meaning.
std::string parameter_help(const ParameterTable& table);

/// What `--dump-yaml` prints: the stage's block of pipeline.yaml with every parameter at its present value
/// and a comment on each. pipeline.yaml is made of these blocks.
std::string parameter_yaml(const std::string& stage, const std::string& summary, const ParameterTable& table);

/// The blocks that pipeline.yaml may have: one per stage, in the order of the pipeline.
const std::vector<std::string>& known_stages();

}  // namespace roomcut

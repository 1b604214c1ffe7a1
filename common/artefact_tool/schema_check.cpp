// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact_tool/schema_check.h"

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "common/artefact/artefact_check.h"
#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"

namespace roomcut {

namespace {

Json parsed(const std::filesystem::path& path) {
  try {
    return parse_json(read_text_file(path));
  } catch (const BadJson& error) {
    throw_damaged(path, "", std::string("is not JSON: ") + error.what());
  }
}

/// "<root>[features][3][properties]" as "features.3.properties".
std::string place(const std::string& context) {
  std::string text;
  for (std::size_t at = context.find('['); at != std::string::npos; at = context.find('[', at + 1)) {
    const std::size_t end = context.find(']', at);
    text += (text.empty() ? "" : ".") + context.substr(at + 1, end - at - 1);
  }
  return text.empty() ? "the top" : text;
}

}  // namespace

std::vector<std::string> schema_violations(const std::filesystem::path& file,
                                           const std::filesystem::path& schema_file) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const Json rules = parsed(schema_file);
  const Json value = parsed(file);
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(rules), schema);
  valijson::ValidationResults results;
  std::vector<std::string> text;
  if (!valijson::Validator().validate(schema, Adapter(value), &results)) {
    valijson::ValidationResults::Error error;
    while (results.popError(error)) {
      std::string context;
      for (const std::string& part : error.context) {
        context += part;
      }
      text.push_back(place(context) + ": " + error.description);
    }
  }
  return text;
}

}  // namespace roomcut

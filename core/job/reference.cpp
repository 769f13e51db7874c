#include "tessera/job/reference.h"

#include <fmt/format.h>

#include <cmath>

namespace tessera {
namespace {

constexpr const char* kDraft = "https://json-schema.org/draft/2020-12/schema";

// "Half side" of "halfSide".
std::string title_of(std::string_view key) {
  std::string title = kebab_case(key);
  for (char& c : title) c = c == '-' ? ' ' : c;
  if (!title.empty() && title[0] >= 'a' && title[0] <= 'z') title[0] = static_cast<char>(title[0] - 'a' + 'A');
  return title;
}

const char* json_type(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kNumber: return "number";
    case ParameterKind::kInteger: return "integer";
    case ParameterKind::kFlag: return "boolean";
    case ParameterKind::kText:
    case ParameterKind::kChoice: break;
  }
  return "string";
}

bool is_numeric(const Parameter& parameter) {
  return parameter.kind == ParameterKind::kNumber || parameter.kind == ParameterKind::kInteger;
}

void add_bounds(const ParameterInfo& info, Json& schema) {
  const auto add = [&](const char* key, double value) {
    if (std::isfinite(value)) schema[key] = tidy_number(value);
  };
  add("minimum", info.min);
  add("maximum", info.max);
  add("x-ui-minimum", info.ui_min);
  add("x-ui-maximum", info.ui_max);
}

Json parameter_schema(const Parameter& parameter) {
  const ParameterInfo& info = parameter.info;
  Json schema = {{"title", title_of(info.key)}, {"description", info.help}, {"type", json_type(parameter.kind)}};
  if (is_numeric(parameter)) add_bounds(info, schema);
  for (const ParameterChoice& choice : parameter.choices) {
    schema["enum"].push_back(choice.name);
    schema["x-enum-descriptions"].push_back(choice.help);
  }
  schema["default"] = parameter.value;
  if (*info.unit) schema["x-unit"] = info.unit;
  if (*info.symbol) schema["x-symbol"] = info.symbol;
  if (info.advanced) schema["x-advanced"] = true;
  return schema;
}

Json inputs_schema(const Technique& technique) {
  Json properties = Json::object(), patterns = Json::object();
  for (const InputRole& role : technique.inputs) {
    const Json one = {{"description", role.help}, {"type", "string"}};
    if (role.many)
      patterns[fmt::format("^{}-[A-Za-z0-9_-]{{1,40}}$", role.name)] = one;
    else
      properties[role.name] = one;
  }
  Json schema = {{"type", "object"}, {"properties", properties}};
  if (!patterns.empty()) schema["patternProperties"] = patterns;
  schema["additionalProperties"] = false;
  return schema;
}

std::string markdown_row(const Parameter& parameter) {
  const ParameterInfo& info = parameter.info;
  std::string meaning = info.help;
  for (const ParameterChoice& choice : parameter.choices) {
    meaning += fmt::format("{} `{}`: {}", &choice == parameter.choices.data() ? "." : ";", choice.name, choice.help);
  }
  const std::string symbol = *info.symbol ? fmt::format("*{}*", info.symbol) : "";
  const std::string values = is_numeric(parameter) ? range_text(info) : expectation(parameter);
  return fmt::format("| `{}` | `--{}` | {} | {} | {} | {} |\n", info.key, kebab_case(info.key), values,
                     plain_text(parameter.value), symbol, meaning);
}

std::string markdown_table(const std::vector<Parameter>& parameters, bool advanced) {
  std::string table;
  for (const Parameter& parameter : parameters) {
    if (parameter.info.advanced == advanced) table += markdown_row(parameter);
  }
  if (table.empty()) return "";
  return "| Parameter | Flag | Values | Default | Symbol | Meaning |\n|---|---|---|---|---|---|\n" + table + "\n";
}

std::string markdown_section(const Technique& technique) {
  std::string section =
      fmt::format("## {}\n\n`tessera {}`: {}.\n\n", title_of(technique.name), technique.command, technique.help);
  const std::vector<Parameter> parameters = parameters_of(technique.defaults);
  section += markdown_table(parameters, false);
  if (const std::string advanced = markdown_table(parameters, true); !advanced.empty()) {
    section += "### Advanced\n\n" + advanced;
  }
  return section;
}

}  // namespace

Json params_schema(const Technique& technique) {
  Json properties = Json::object();
  for (const Parameter& parameter : parameters_of(technique.defaults)) {
    properties[parameter.info.key] = parameter_schema(parameter);
  }
  return {{"$schema", kDraft}, {"title", technique.name},  {"description", technique.help},
          {"type", "object"},  {"properties", properties}, {"additionalProperties", false}};
}

Json job_schema() {
  Json names = Json::array(), alternatives = Json::array(), definitions = Json::object();
  for (const Technique& technique : techniques()) {
    const std::string name(technique.name);
    names.push_back(name);
    alternatives.push_back({{"properties",
                             {{"technique", {{"const", name}}},
                              {"params", {{"$ref", "#/$defs/" + name}}},
                              {"inputs", inputs_schema(technique)}}}});
    definitions[name] = params_schema(technique);
    definitions[name].erase("$schema");  // belongs to a document's root
  }
  const Json properties = {
      {"schemaVersion", {{"const", kSchemaVersion}}},
      {"technique", {{"enum", names}}},
      {"seed",
       {{"description", kSeedInfo.help}, {"type", "integer"}, {"minimum", 0}, {"maximum", kMaxSeed}, {"default", 1}}},
      {"params", {{"type", "object"}}},
      {"inputs", {{"type", "object"}}}};
  return {{"$schema", kDraft},
          {"title", "Tessera job"},
          {"type", "object"},
          {"properties", properties},
          {"required", {"schemaVersion", "technique"}},
          {"additionalProperties", false},
          {"oneOf", alternatives},
          {"$defs", definitions}};
}

std::string parameter_reference() {
  std::string text =
      "# Parameters\n\n"
      "Made by `tessera schema --markdown` from the description that each technique gives of itself. A parameter "
      "has\n"
      "the same name in a job's JSON and, in kebab-case, as a flag.\n\n";
  for (const Technique& technique : techniques()) text += markdown_section(technique);
  text.pop_back();  // one line end at the end of the file
  return text;
}

}  // namespace tessera

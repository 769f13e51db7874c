#include "tessera/job/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "tessera/job/techniques.h"

namespace tessera {
namespace {

constexpr std::size_t kLongestShown = 40;

// A parameter, and how to give it another value; bound to the struct that was visited.
struct Field {
  Parameter parameter;
  std::function<void(const Json&)> assign;  // the value has been found valid
};

// The visitor from which everything else is made.
class FieldCollector {
 public:
  void number(double& field, const ParameterInfo& info) {
    add(info, ParameterKind::kNumber, tidy_number(field), [&field](const Json& v) { field = v.get<double>(); });
  }
  void integer(int& field, const ParameterInfo& info) {
    ParameterInfo within = info;  // what an int can hold
    within.min = std::max<double>(info.min, std::numeric_limits<int>::min());
    within.max = std::min<double>(info.max, std::numeric_limits<int>::max());
    add(within, ParameterKind::kInteger, field,
        [&field](const Json& v) { field = static_cast<int>(v.get<double>()); });
  }
  void flag(bool& field, const ParameterInfo& info) {
    add(info, ParameterKind::kFlag, field, [&field](const Json& v) { field = v.get<bool>(); });
  }
  void text(std::string& field, const ParameterInfo& info) {
    add(info, ParameterKind::kText, field, [&field](const Json& v) { field = v.get<std::string>(); });
  }
  template <class Enum>
  void choice(Enum& field, const ParameterInfo& info, std::initializer_list<Choice<Enum>> choices) {
    const auto is_current = [&](const Choice<Enum>& c) { return c.value == field; };
    const auto current = std::find_if(choices.begin(), choices.end(), is_current);
    add(info, ParameterKind::kChoice, current == choices.end() ? Json() : Json(current->name),
        [&field, all = std::vector<Choice<Enum>>(choices)](const Json& v) {
          const auto name = v.get<std::string>();
          field = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; })->value;
        });
    for (const Choice<Enum>& c : choices) fields.back().parameter.choices.push_back({c.name, c.help});
  }

  std::vector<Field> fields;

 private:
  void add(const ParameterInfo& info, ParameterKind kind, Json value, std::function<void(const Json&)> assign) {
    fields.push_back({{info, kind, std::move(value), {}}, std::move(assign)});
  }
};

// The fields refer to `params` and live no longer than it.
std::vector<Field> fields_of(TechniqueParams& params) {
  FieldCollector collector;
  std::visit([&](auto& p) { visit(collector, p); }, params);
  return std::move(collector.fields);
}

// What the technique says of fields that are valid each by itself.
void check_together(const TechniqueParams& params, Problems& problems) {
  const auto report = [&](std::string key, std::string message) {
    problems.push_back({StatusCode::kInvalidParameter, std::move(key), std::move(message)});
  };
  std::visit([&](const auto& p) { check(p, report); }, params);
}

bool has_right_type(const Parameter& parameter, const Json& value) {
  switch (parameter.kind) {
    case ParameterKind::kNumber: return value.is_number();
    case ParameterKind::kInteger: return value.is_number() && value.get<double>() == std::floor(value.get<double>());
    case ParameterKind::kFlag: return value.is_boolean();
    case ParameterKind::kText: return value.is_string();
    case ParameterKind::kChoice: break;
  }
  const auto is_named = [&](const ParameterChoice& c) { return value == c.name; };
  return std::any_of(parameter.choices.begin(), parameter.choices.end(), is_named);
}

std::string unknown_key_message(const TechniqueParams& params, const std::vector<Field>& fields) {
  std::vector<std::string> keys;
  for (const Field& field : fields) keys.emplace_back(field.parameter.info.key);
  return fmt::format("is no parameter of {}, expected {}", technique_of(params).name, either_of(keys));
}

}  // namespace

std::vector<Parameter> parameters_of(const TechniqueParams& params) {
  TechniqueParams copy = params;
  std::vector<Parameter> all;
  for (Field& field : fields_of(copy)) all.push_back(std::move(field.parameter));
  return all;
}

std::string range_text(const ParameterInfo& info) {
  const std::string unit = *info.unit ? fmt::format(" {}", info.unit) : "";
  const bool from = std::isfinite(info.min), to = std::isfinite(info.max);
  if (from && to) return fmt::format("{} to {}{}", info.min, info.max, unit);
  if (from) return fmt::format("at least {}{}", info.min, unit);
  if (to) return fmt::format("at most {}{}", info.max, unit);
  return "";
}

std::string expectation(const Parameter& parameter) {
  const std::string range = range_text(parameter.info);
  const std::string tail = range.empty() ? "" : ", " + range;
  switch (parameter.kind) {
    case ParameterKind::kNumber: return "a number" + tail;
    case ParameterKind::kInteger: return "a whole number" + tail;
    case ParameterKind::kFlag: return "true or false";
    case ParameterKind::kText: return "a text";
    case ParameterKind::kChoice: break;
  }
  std::vector<std::string> names;
  for (const ParameterChoice& choice : parameter.choices) names.emplace_back(choice.name);
  return either_of(names);
}

std::string kebab_case(std::string_view key) {
  std::string flag;
  for (const char c : key) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper) flag += '-';
    flag += upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return flag;
}

std::string either_of(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::string shown(const Json& value) {
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());  // JSON has no NaN, a message may
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongestShown) text.erase(kLongestShown).append("...");
  return text;
}

std::string shown_key(const std::string& key) { return key.size() > kLongestShown ? shown(key) : key; }

std::string plain_text(const Json& value) { return value.is_string() ? value.get<std::string>() : shown(value); }

Json tidy_number(double value) {
  if (std::abs(value) < 1e15 && value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

std::optional<std::string> complaint(const Parameter& parameter, const Json& value) {
  if (!has_right_type(parameter, value)) {
    return fmt::format("is {}, expected {}", shown(value), expectation(parameter));
  }
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  if (!std::isfinite(number)) return fmt::format("is {}, expected {}", shown(value), expectation(parameter));
  if (number >= parameter.info.min && number <= parameter.info.max) return std::nullopt;
  return fmt::format("is {}, expected {}", shown(value), range_text(parameter.info));
}

Json write_params(const TechniqueParams& params) {
  Json object = Json::object();
  for (const Parameter& parameter : parameters_of(params)) object[parameter.info.key] = parameter.value;
  return object;
}

void read_params(const Json& object, TechniqueParams& params, Problems& problems) {
  if (!object.is_object()) {
    problems.push_back(
        {StatusCode::kInvalidParameter, "params", fmt::format("is {}, expected an object", shown(object))});
    return;
  }
  const std::size_t problems_before = problems.size();
  const std::vector<Field> fields = fields_of(params);
  for (const auto& [key, value] : object.items()) {
    const auto has_key = [&name = key](const Field& f) { return f.parameter.info.key == name; };
    const auto field = std::find_if(fields.begin(), fields.end(), has_key);
    if (field == fields.end()) {
      problems.push_back({StatusCode::kInvalidParameter, shown_key(key), unknown_key_message(params, fields)});
    } else if (auto trouble = complaint(field->parameter, value)) {
      problems.push_back({StatusCode::kInvalidParameter, key, *std::move(trouble)});
    } else {
      field->assign(value);
    }
  }
  if (problems.size() == problems_before) check_together(params, problems);
}

void check_params(const TechniqueParams& params, Problems& problems) {
  const std::size_t problems_before = problems.size();
  for (const Parameter& parameter : parameters_of(params)) {
    if (auto trouble = complaint(parameter, parameter.value)) {
      problems.push_back({StatusCode::kInvalidParameter, parameter.info.key, *std::move(trouble)});
    }
  }
  if (problems.size() == problems_before) check_together(params, problems);
}

}  // namespace tessera

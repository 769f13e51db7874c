#include "tessera/cli/flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "tessera/io/file.h"

namespace tessera {
namespace {

template <class Number>
std::optional<Number> parse_number(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

const char* type_name(const Parameter& parameter) {
  switch (parameter.kind) {
    case ParameterKind::kNumber: return "X";
    case ParameterKind::kInteger: return "N";
    case ParameterKind::kFlag: return "true|false";
    case ParameterKind::kText: return "TEXT|FILE";
    case ParameterKind::kChoice: break;
  }
  return "NAME";
}

// A text too long to type may lie in a file.
std::string text_or_file(const std::string& value) {
  constexpr std::uintmax_t kLongest = 1 << 20;
  std::error_code error;
  if (!std::filesystem::is_regular_file(value, error) || std::filesystem::file_size(value, error) > kLongest)
    return value;
  return read_file(value).value_or(value);
}

// "Half the side of a stone: 1 to 512 px; default 4"
std::string description(const Parameter& parameter) {
  std::vector<std::string> choices;
  for (const ParameterChoice& choice : parameter.choices) {
    choices.push_back(fmt::format("{} ({})", choice.name, choice.help));
  }
  const std::string values = choices.empty() ? range_text(parameter.info) : either_of(choices);
  std::string text = parameter.info.help;
  if (!values.empty()) text += ": " + values;
  if (!parameter.value.is_null()) text += "; default " + plain_text(parameter.value);
  return text;
}

}  // namespace

std::string flag_of(const Parameter& parameter) { return "--" + kebab_case(parameter.info.key); }

std::string upper_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  return result;
}

Json parse_value(const Parameter& parameter, const std::string& text) {
  switch (parameter.kind) {
    case ParameterKind::kNumber:
    case ParameterKind::kInteger:
      if (const auto whole = parse_number<std::int64_t>(text)) return *whole;
      if (const auto number = parse_number<double>(text)) return *number;
      break;
    case ParameterKind::kFlag:
      if (text == "true" || text == "false") return text == "true";
      break;
    case ParameterKind::kText:
    case ParameterKind::kChoice: break;
  }
  return text;
}

ParameterFlags::ParameterFlags(CLI::App& command, const std::string& group, std::vector<Parameter> parameters) {
  for (Parameter& parameter : parameters) flags_.push_back({std::move(parameter), {}, nullptr});
  for (Flag& flag : flags_) {
    flag.option = command.add_option(flag_of(flag.parameter), flag.text, description(flag.parameter))
                      ->type_name(type_name(flag.parameter))
                      ->group(group);
  }
}

Json ParameterFlags::given() const {
  Json values = Json::object();
  for (const Flag& flag : flags_) {
    if (flag.option->count() == 0) continue;
    const bool is_text = flag.parameter.kind == ParameterKind::kText;
    values[flag.parameter.info.key] = parse_value(flag.parameter, is_text ? text_or_file(flag.text) : flag.text);
  }
  return values;
}

void ParameterFlags::name_flags(Problems& problems) const {
  for (Status& problem : problems) {
    const auto is_named = [&](const Flag& flag) { return problem.field == flag.parameter.info.key; };
    const auto flag = std::find_if(flags_.begin(), flags_.end(), is_named);
    if (flag != flags_.end()) problem.message += fmt::format(" ({})", flag_of(flag->parameter));
  }
}

}  // namespace tessera

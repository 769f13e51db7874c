#include "tessera/parquetry/panel_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/base/text.h"

namespace tessera::parquetry {
namespace {

constexpr std::string_view kNoMarks = "none";
constexpr std::size_t kFewestPlaces = 3;  // that say how a panel lies
constexpr double kLeastDpi = 20, kMostDpi = 10000, kMostMargin = 1000, kFarthest = 1e6;

bool read_number(std::string_view text, double low, double high, double& value) {
  double number = 0;
  if (!parse_number(text, number) || !(number >= low && number <= high)) return false;
  value = number;
  return true;
}

// "10:10,160:10"
std::optional<std::vector<Point>> read_points(std::string_view text) {
  std::vector<Point> read;
  for (const std::string_view pair : split(text, ",")) {
    const auto numbers = split(pair, ":");
    Point p;
    if (numbers.size() != 2 || !read_number(numbers[0], -kFarthest, kFarthest, p.x) ||
        !read_number(numbers[1], -kFarthest, kFarthest, p.y))
      return std::nullopt;
    read.push_back(p);
  }
  return read;
}

// What the option must be; empty where it is.
std::string read_option(std::string_view key, std::string_view value, PanelOptions& options) {
  if (key == "dpi")
    return read_number(value, kLeastDpi, kMostDpi, options.dpi)
               ? ""
               : fmt::format("{} to {} pixels an inch", kLeastDpi, kMostDpi);
  if (key == "margin")
    return read_number(value, 0, kMostMargin, options.margin_mm) ? "" : fmt::format("0 to {} mm", kMostMargin);
  if (key == "marks") {
    options.marks = value == kNoMarks ? std::vector<Point>() : read_points(value);
    return options.marks && (value == kNoMarks || !options.marks->empty()) ? "" : "places x:y,x:y or none";
  }
  if (key == "machine") {
    const auto places = read_points(value);
    if (!places || places->size() < kFewestPlaces) return "three or more places x:y,x:y";
    options.machine = *places;
    return "";
  }
  return "dpi, margin, marks or machine";
}

}  // namespace

bool is_panel_name(std::string_view name) {
  constexpr std::size_t kLongest = 40;
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), is_plain);
}

std::vector<PanelOptions> read_panel_options(std::string_view text, const std::function<void(std::string)>& report) {
  std::vector<PanelOptions> all;
  const auto complain = [&](std::string message) {
    if (report) report(std::move(message));
  };
  for (const std::string_view entry : split(text, ";\n")) {
    const auto words = split(entry, " \t\r");
    if (words.empty()) continue;
    PanelOptions options;
    options.name = words[0];
    if (!is_panel_name(options.name))
      complain(fmt::format("has \"{}\" where a panel's name was expected: letters, digits, - and _", words[0]));
    if (std::any_of(all.begin(), all.end(), [&](const PanelOptions& o) { return o.name == options.name; }))
      complain(fmt::format("has {} twice", options.name));
    for (std::size_t i = 1; i < words.size(); ++i) {
      const std::size_t equals = std::min(words[i].find('='), words[i].size());
      const std::string_view key = words[i].substr(0, equals);
      const std::string expected = read_option(key, words[i].substr(std::min(equals + 1, words[i].size())), options);
      if (!expected.empty())
        complain(fmt::format("has \"{}\" for {}, expected {}", words[i], options.name, expected));
    }
    if (options.marks && !options.machine.empty() && options.marks->size() != options.machine.size())
      complain(fmt::format("has {} marks for {} and {} places on the machine, expected as many",
                           options.marks->size(), options.name, options.machine.size()));
    all.push_back(std::move(options));
  }
  return all;
}

}  // namespace tessera::parquetry

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tessera/job/measure.h"
#include "tessera/statistics/classes.h"

namespace tessera {
namespace {

constexpr int kMostNeedles = 100'000'000;

bool is_length(const Json& value) {
  return value.is_number() && value.get<double>() > 0 && value.get<double>() < 1e9;
}

bool is_whole(const Json& value, double least, double most) {
  if (!value.is_number()) return false;
  const double number = value.get<double>();
  return number >= least && number <= most && number == std::floor(number);
}

bool are_lengths(const Json& list) { return list.is_array() && std::all_of(list.begin(), list.end(), is_length); }

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const auto& model : statistics::cell_models()) names.emplace_back(model.name);
  return names;
}

}  // namespace

tl::expected<MeasureOptions, Problems> read_measure_options(const Json& json) {
  MeasureOptions options;
  Problems problems;
  const auto wrong = [&](const char* key, std::string message) {
    problems.push_back({StatusCode::kInvalidParameter, key, std::move(message)});
  };
  // Takes the value where there is one that `fits`, else says what was expected.
  const auto read = [&](const char* key, const auto& fits, const std::string& expected, const auto& take) {
    if (!json.contains(key)) return;
    if (fits(json[key]))
      take(json[key]);
    else
      wrong(key, fmt::format("is {}, expected {}", shown(json[key]), expected));
  };

  if (!json.is_object()) {
    wrong("options", fmt::format("is {}, expected an object", shown(json)));
    return tl::unexpected<Problems>(std::move(problems));
  }
  const std::vector<std::string> names = model_names();
  const auto known = [&](const Json& name) {
    return name.is_string() && std::find(names.begin(), names.end(), name.get<std::string>()) != names.end();
  };
  Comparison comparison;
  read("model", known, either_of(names), [&](const Json& name) {
    for (const auto& model : statistics::cell_models())
      if (model.name == name.get<std::string>()) comparison.model = model.model;
  });
  if (json.contains("model")) {
    if (json.contains("lambda") && is_length(json["lambda"]))
      comparison.x = json["lambda"];
    else
      wrong("lambda", "is missing or not above 0, expected the model's number");
    options.comparison = comparison;
  }
  read("distances", are_lengths, "lengths above 0", [&](const Json& list) {
    for (const Json& d : list) options.distances.push_back(d);
  });
  read(
      "window", [](const Json& v) { return are_lengths(v) && v.size() == 2; }, "a width and a height above 0",
      [&](const Json& size) { options.width = size[0], options.height = size[1]; });
  read(
      "needles", [](const Json& v) { return is_whole(v, 1, kMostNeedles); }, fmt::format("1 to {}", kMostNeedles),
      [&](const Json& count) { options.needles = static_cast<int>(count.get<double>()); });
  read(
      "colors", [](const Json& v) { return is_whole(v, 0, statistics::kMostClasses) && v.get<double>() != 1; },
      fmt::format("2 to {}, or 0 for as many as there are", statistics::kMostClasses),
      [&](const Json& count) { options.colors = static_cast<int>(count.get<double>()); });
  read(
      "seed", [](const Json& v) { return is_whole(v, 0, static_cast<double>(kMaxSeed)); },
      fmt::format("0 to {}", kMaxSeed),
      [&](const Json& seed) { options.seed = static_cast<std::uint64_t>(seed.get<double>()); });
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  return options;
}

}  // namespace tessera

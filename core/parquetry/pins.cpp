#include "tessera/parquetry/pins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/text.h"

namespace tessera::parquetry {
namespace {

bool read_pair(std::string_view text, double& first, double& second) {
  const auto numbers = split(text, ",");
  return numbers.size() == 2 && parse_number(numbers[0], first) && parse_number(numbers[1], second);
}

}  // namespace

std::vector<Pin> read_pins(std::string_view text, const std::function<void(std::string)>& report) {
  constexpr double kMostVertices = 1e5, kFarthestMm = 1e6;
  std::vector<Pin> pins;
  for (const std::string_view word : split(text, "; \t\r\n")) {
    const auto halves = split(word, ":");
    double column = -1, row = -1;
    Pin pin;
    const auto is_count = [](double v) { return v >= 0 && v <= kMostVertices && v == std::floor(v); };
    const bool good = halves.size() == 2 && read_pair(halves[0], column, row) &&
                      read_pair(halves[1], pin.at.x, pin.at.y) && is_count(column) && is_count(row) &&
                      std::abs(pin.at.x) <= kFarthestMm && std::abs(pin.at.y) <= kFarthestMm;
    pin.column = good ? static_cast<int>(column) : -1, pin.row = good ? static_cast<int>(row) : -1;
    const bool twice = std::any_of(pins.begin(), pins.end(), [&](const Pin& other) {
      return other.column == pin.column && other.row == pin.row;
    });
    if (!good && report)
      report(fmt::format("has \"{}\", expected a vertex and its place in mm, such as 3,4:123.5,87.2", word));
    if (good && twice && report) report(fmt::format("has vertex {},{} twice", pin.column, pin.row));
    if (good && !twice) pins.push_back(pin);
  }
  return pins;
}

std::string write_pins(const std::vector<Pin>& pins) {
  const auto rounded = [](double mm) { return std::round(100 * mm) / 100 + 0.0; };  // no -0
  std::string text;
  for (const Pin& pin : pins)
    text += fmt::format("{}{},{}:{},{}", text.empty() ? "" : "; ", pin.column, pin.row, rounded(pin.at.x),
                        rounded(pin.at.y));
  return text;
}

}  // namespace tessera::parquetry

#include "tessera/job/pattern_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "tessera/base/text.h"
#include "tessera/job/job_json.h"

namespace tessera {
namespace {

using PlainJson = nlohmann::json;

tl::unexpected<Status> unusable(std::string message) {
  return fail(StatusCode::kInvalidInput, "", std::move(message));
}

constexpr double kFarthest = 1e9;

std::optional<Point> point_of(const PlainJson& position) {
  if (!position.is_array() || position.size() < 2 || !position[0].is_number() || !position[1].is_number()) return {};
  const Point p{position[0].get<double>(), position[1].get<double>()};
  if (!(std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest)) return {};
  return p;
}

// ---- JSON

// The outer ring, its last position, which is the first again, left out.
std::optional<Ring> ring_of(const PlainJson& coordinates) {
  if (!coordinates.is_array() || coordinates.empty() || !coordinates[0].is_array()) return {};
  Ring ring;
  for (const PlainJson& position : coordinates[0]) {
    const auto p = point_of(position);
    if (!p) return {};
    ring.push_back(*p);
  }
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (ring.size() < 3) return {};
  if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

Result<void> take_feature(const PlainJson& feature, std::size_t index, PatternFile& file) {
  const auto wrong = [&] {
    return unusable(fmt::format("feature {} is neither a Polygon nor a Point with finite coordinates", index + 1));
  };
  if (!feature.is_object() || !feature.contains("geometry") || !feature["geometry"].is_object()) return wrong();
  const PlainJson& geometry = feature["geometry"];
  if (!geometry.contains("type") || !geometry.contains("coordinates")) return wrong();
  const PlainJson& type = geometry["type"];
  if (type == "Point") {
    const auto p = point_of(geometry["coordinates"]);
    if (!p) return wrong();
    file.points.push_back(*p);
    return {};
  }
  auto ring = type == "Polygon" ? ring_of(geometry["coordinates"]) : std::nullopt;
  if (!ring) return wrong();
  file.cells.push_back(*std::move(ring));
  return {};
}

Result<PatternFile> from_features(const PlainJson& json) {
  PatternFile file;
  if (json.contains("bbox") && json["bbox"].is_array() && json["bbox"].size() == 4) {
    const PlainJson& box = json["bbox"];
    const auto low = point_of({box[0], box[1]}), high = point_of({box[2], box[3]});
    if (low && high) file.window = {*low, *high};
  }
  const PlainJson& features = json["features"];
  for (std::size_t i = 0; i < features.size(); ++i)
    if (auto done = take_feature(features[i], i, file); !done) return tl::unexpected<Status>(std::move(done.error()));
  return file;
}

Result<PatternFile> from_json(std::string_view bytes) {
  const PlainJson json = PlainJson::parse(bytes, nullptr, false);
  if (json.is_discarded()) return unusable("is no valid JSON");
  if (json.is_object() && json.contains("features") && json["features"].is_array()) return from_features(json);
  if (!json.is_array()) return unusable("is JSON, expected a GeoJSON FeatureCollection or a list of [x, y]");
  PatternFile file;
  for (const PlainJson& position : json) {
    const auto p = point_of(position);
    if (!p) return unusable(fmt::format("entry {} is no [x, y]", file.points.size() + 1));
    file.points.push_back(*p);
  }
  return file;
}

// ---- CSV

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(",;\t", begin), line.size());
    std::string_view field = line.substr(begin, end - begin);
    while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '\r')) field.remove_suffix(1);
    fields.push_back(field);
    begin = end + 1;
  }
  return fields;
}

struct Columns {
  std::size_t x = 0, y = 1;
  bool header = false;
};

Columns columns_of(const std::vector<std::string_view>& first) {
  const auto index = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(first.begin(), first.end(), name) - first.begin());
  };
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {
      {"x", "y"}, {"x_mm", "y_mm"}, {"centroid_x", "centroid_y"}};
  for (const auto& [x, y] : kNames)
    if (index(x) < first.size() && index(y) < first.size()) return {index(x), index(y), true};
  double ignored = 0;
  return {0, 1, !first.empty() && !parse_number(first[0], ignored)};
}

Result<PatternFile> from_csv(std::string_view bytes) {
  PatternFile file;
  std::optional<Columns> columns;
  std::size_t number = 0;
  for (const std::string_view line : split(bytes, "\n")) {
    ++number;
    const std::vector<std::string_view> fields = fields_of(line);
    if (!columns) {
      columns = columns_of(fields);
      if (columns->header) continue;
    }
    Point p;
    if (std::max(columns->x, columns->y) >= fields.size() || !parse_number(fields[columns->x], p.x) ||
        !parse_number(fields[columns->y], p.y) || !(std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest))
      return unusable(fmt::format("line {} has no two numbers, expected x and y", number));
    file.points.push_back(p);
  }
  return file;
}

// ---- SVG, as write_svg() makes it

std::optional<std::string_view> attribute(std::string_view tag, std::string_view name) {
  const std::size_t at = tag.find(fmt::format(" {}=\"", name));
  if (at == std::string_view::npos) return {};
  const std::size_t begin = at + name.size() + 3, end = tag.find('"', begin);
  if (end == std::string_view::npos) return {};
  return tag.substr(begin, end - begin);
}

bool read_numbers(std::string_view text, std::vector<double>& numbers) {
  numbers.clear();
  for (const std::string_view word : split(text, " ,\n")) {
    double number = 0;
    if (!parse_number(word, number) || !(std::abs(number) < kFarthest)) return false;
    numbers.push_back(number);
  }
  return true;
}

// "M1 2L3 4 5 6Z": the first ring of straight sides.
std::optional<Ring> ring_of_path(std::string_view path) {
  const std::size_t begin = path.find('M'), end = std::min(path.find('Z'), path.size());
  if (begin == std::string_view::npos || begin > end) return {};
  std::string text(path.substr(begin + 1, end - begin - 1));
  std::replace(text.begin(), text.end(), 'L', ' ');
  std::vector<double> numbers;
  if (!read_numbers(text, numbers) || numbers.size() < 6 || numbers.size() % 2 != 0) return {};
  Ring ring;
  for (std::size_t i = 0; i < numbers.size(); i += 2) ring.push_back({numbers[i], numbers[i + 1]});
  if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

Result<PatternFile> from_svg(std::string_view bytes) {
  PatternFile file;
  std::vector<double> box;
  const std::size_t start = bytes.find("<svg");
  if (start != std::string_view::npos) {
    const auto view = attribute(bytes.substr(start, bytes.find('>', start) - start), "viewBox");
    if (view && read_numbers(*view, box) && box.size() == 4)
      file.window = {{box[0], box[1]}, {box[0] + box[2], box[1] + box[3]}};
  }
  if (auto job = extract_job_from_svg(bytes)) file.job_json = *std::move(job);
  std::size_t number = 0;
  for (std::size_t at = bytes.find("<path"); at != std::string_view::npos; at = bytes.find("<path", at + 5)) {
    ++number;
    const std::string_view tag = bytes.substr(at, bytes.find('>', at) - at);
    const auto path = attribute(tag, "d"), kind = attribute(tag, "class");
    auto ring = path ? ring_of_path(*path) : std::nullopt;
    if (!ring) return unusable(fmt::format("path {} is no polygon of straight sides", number));
    if (kind == "point")
      file.points.push_back(centroid(*ring));
    else
      file.cells.push_back(*std::move(ring));
  }
  return file;
}

Result<PatternFile> read_any(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string_view::npos) return unusable("is empty");
  switch (bytes[first]) {
    case '{':
    case '[': return from_json(bytes.substr(first));
    case '<': return from_svg(bytes);
    default: return from_csv(bytes.substr(first));
  }
}

}  // namespace

Result<PatternFile> read_pattern_file(std::string_view bytes) {
  auto file = read_any(bytes);
  if (file && file->cells.empty() && file->points.empty()) return unusable("has neither cells nor points");
  if (file && !file->cells.empty() && !file->points.empty())
    return unusable("has both cells and points, expected one kind");
  return file;
}

}  // namespace tessera

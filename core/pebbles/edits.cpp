#include "tessera/pebbles/edits.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tessera/base/text.h"
#include "tessera/geometry/scan.h"
#include "tessera/pebbles/neighbours.h"

namespace tessera::pebbles {
namespace {

struct Command {
  std::string_view name;
  Edit::Kind kind;
  std::size_t least_points;
};

constexpr Command kCommands[] = {{"merge", Edit::Kind::kMerge, 2},
                                 {"split", Edit::Kind::kSplit, 2},
                                 {"delete", Edit::Kind::kDelete, 1},
                                 {"add", Edit::Kind::kAdd, 3}};

bool parse_point(std::string_view text, Point& point) {
  const auto numbers = split(text, ",");
  return numbers.size() == 2 && parse_number(numbers[0], point.x) && parse_number(numbers[1], point.y);
}

bool parse_edit(const std::vector<std::string_view>& words, Edit& edit) {
  const auto command =
      std::find_if(std::begin(kCommands), std::end(kCommands), [&](const Command& c) { return c.name == words[0]; });
  if (command == std::end(kCommands) || words.size() < 1 + command->least_points) return false;
  edit = {command->kind, std::vector<Point>(words.size() - 1)};
  for (std::size_t k = 1; k < words.size(); ++k)
    if (!parse_point(words[k], edit.points[k - 1])) return false;
  return true;
}

int label_at(const cv::Mat1i& labels, Point p) {
  const bool inside = p.x >= 0 && p.y >= 0 && p.x < labels.cols && p.y < labels.rows;
  return inside ? labels(static_cast<int>(p.y), static_cast<int>(p.x)) : 0;
}

// The labels under the points, each once, in their order.
std::vector<int> labels_under(const std::vector<Point>& points, const cv::Mat1i& labels) {
  std::vector<int> found;
  for (const Point p : points) {
    const int label = label_at(labels, p);
    if (label != 0 && std::find(found.begin(), found.end(), label) == found.end()) found.push_back(label);
  }
  return found;
}

// All become the first, with the ground between them.
bool merge(const std::vector<Point>& points, cv::Mat1i& labels) {
  const std::vector<int> parts = labels_under(points, labels);
  if (parts.size() < 2) return false;
  std::vector<cv::Point> pixels;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (std::find(parts.begin(), parts.end(), labels(y, x)) != parts.end()) {
        labels(y, x) = parts[0];
        pixels.emplace_back(x, y);
      }
  std::vector<cv::Point> hull;
  cv::convexHull(pixels, hull);
  cv::Mat1b inside(labels.size(), std::uint8_t{0});
  cv::fillConvexPoly(inside, hull, 1);
  labels.setTo(parts[0], (inside != 0) & (labels == 0));
  return true;
}

// Each pixel goes to the nearest of the points on its pebble; the first point's part keeps the label.
bool split_at(const std::vector<Point>& points, cv::Mat1i& labels) {
  const int label = label_at(labels, points[0]);
  std::vector<Point> own;
  for (const Point p : points)
    if (label != 0 && label_at(labels, p) == label) own.push_back(p);
  if (own.size() < 2) return false;
  const int fresh = largest_label(labels);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      if (labels(y, x) != label) continue;
      const auto distance = [&](Point p) { return length(p - Point{x + 0.5, y + 0.5}); };
      const auto nearest =
          std::min_element(own.begin(), own.end(), [&](Point a, Point b) { return distance(a) < distance(b); });
      if (nearest != own.begin()) labels(y, x) = fresh + static_cast<int>(nearest - own.begin());
    }
  return true;
}

bool remove(const std::vector<Point>& points, cv::Mat1i& labels) {
  const std::vector<int> gone = labels_under(points, labels);
  for (int& label : labels)
    if (std::find(gone.begin(), gone.end(), label) != gone.end()) label = 0;
  return !gone.empty();
}

bool add(const std::vector<Point>& outline, cv::Mat1i& labels) {
  const int fresh = largest_label(labels) + 1;
  bool any = false;
  each_run(outline, labels.cols, labels.rows, [&](int y, int begin, int end) {
    std::fill(labels[y] + begin, labels[y] + end, fresh);
    any = true;
  });
  return any;
}

bool apply(const Edit& edit, cv::Mat1i& labels) {
  switch (edit.kind) {
    case Edit::Kind::kMerge: return merge(edit.points, labels);
    case Edit::Kind::kSplit: return split_at(edit.points, labels);
    case Edit::Kind::kDelete: return remove(edit.points, labels);
    case Edit::Kind::kAdd: return add(edit.points, labels);
  }
  return false;
}

}  // namespace

bool parse_edits(std::string_view text, std::vector<Edit>& edits) {
  edits.clear();
  for (const std::string_view line : split(text, ";\n\r")) {
    const auto words = split(line, " \t");
    if (words.empty() || words[0][0] == '#') continue;
    Edit edit{};
    if (!parse_edit(words, edit)) return false;
    edits.push_back(std::move(edit));
  }
  return true;
}

int apply_edits(const std::vector<Edit>& edits, double scale, cv::Mat1i& labels) {
  int effective = 0;
  for (Edit edit : edits) {
    for (Point& p : edit.points) p = scale * p;
    effective += apply(edit, labels) ? 1 : 0;
  }
  return effective;
}

}  // namespace tessera::pebbles

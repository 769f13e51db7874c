#include "tessera/pebbles/level_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tessera/pebbles/neighbours.h"

namespace tessera::pebbles {
namespace {

// How many of the levels 1/L, 2/L, ... are at most value / 255 / ratio.
std::array<int, 256> levels_within(double ratio) {
  std::array<int, 256> levels{};
  for (int value = 0; value < 256; ++value)
    levels[value] = static_cast<int>(std::min<double>(kLevels, std::floor(kLevels * value / (255 * ratio))));
  return levels;
}

}  // namespace

// In place of a loop over the levels: those that see a change lie above f / tau and reach up to the brightest
// neighbour n, floor(L n) - floor(L f / tau) of them.
cv::Mat1w level_changes(const cv::Mat1b& intensity, double ratio) {
  const std::array<int, 256> reached = levels_within(1), held = levels_within(ratio);
  cv::Mat1w changes(intensity.size());
  for (int y = 0; y < intensity.rows; ++y)
    for (int x = 0; x < intensity.cols; ++x) {
      std::uint8_t brightest = 0;
      each_neighbour(intensity, y, x, [&](int v, int u) { brightest = std::max(brightest, intensity(v, u)); });
      changes(y, x) = static_cast<std::uint16_t>(std::max(0, reached[brightest] - held[intensity(y, x)]));
    }
  return changes;
}

// Over all pixels the quartile would mostly be 0, as wherever a quarter of the picture is smooth.
int first_quartile(const cv::Mat1w& changes) {
  std::array<std::int64_t, kLevels + 1> histogram{};
  for (const std::uint16_t c : changes) ++histogram[c];
  const std::int64_t changed = static_cast<std::int64_t>(changes.total()) - histogram[0];
  if (changed == 0) return 0;
  int level = 1;
  for (std::int64_t below = histogram[1]; 4 * below < changed; below += histogram[level]) ++level;
  return level;
}

cv::Mat1b hysteresis(const cv::Mat1w& changes, int high) {
  cv::Mat1b edges(changes.size(), std::uint8_t{0});
  std::vector<cv::Point> open;
  const auto take = [&](int y, int x) {
    edges(y, x) = 255;
    open.emplace_back(x, y);
  };
  for (int y = 0; y < changes.rows; ++y)
    for (int x = 0; x < changes.cols; ++x)
      if (changes(y, x) > 0 && changes(y, x) >= high) take(y, x);
  while (!open.empty()) {
    const cv::Point p = open.back();
    open.pop_back();
    for (int y = std::max(0, p.y - 1); y <= std::min(changes.rows - 1, p.y + 1); ++y)
      for (int x = std::max(0, p.x - 1); x <= std::min(changes.cols - 1, p.x + 1); ++x)
        if (edges(y, x) == 0 && changes(y, x) > 0 && 3 * changes(y, x) >= high) take(y, x);  // t_L = t_H / 3
  }
  return edges;
}

cv::Mat1b level_edges(const cv::Mat3b& photo, int median_radius, double ratio) {
  cv::Mat1b intensity, calm;
  cv::cvtColor(photo, intensity, cv::COLOR_RGB2GRAY);
  cv::medianBlur(intensity, calm, 2 * median_radius + 1);
  const cv::Mat1w changes = level_changes(calm, ratio);
  return hysteresis(changes, first_quartile(changes));
}

}  // namespace tessera::pebbles

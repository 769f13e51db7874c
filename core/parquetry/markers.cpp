#include "tessera/parquetry/markers.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "tessera/base/portable_math.h"

namespace tessera::parquetry {
namespace {

constexpr double kLeastMm = 1.5, kMostMm = 20;
constexpr double kRoundness = 0.08;  // by which area and sides of a disc may be off, and a pixel for the sampling
constexpr int kContrast = 70;        // levels to the ground
constexpr std::size_t kFewest = 3;

// The mean brightness of a circle of this radius, and its darkest pixel.
struct Surroundings {
  int mean, darkest;
};

std::optional<Surroundings> around(const cv::Mat1b& grey, Point at, double radius) {
  constexpr int kSamples = 48;
  int sum = 0, darkest = 255, seen = 0;
  for (int k = 0; k < kSamples; ++k) {
    const SinCos turn = sin_cos(2 * kPi * k / kSamples);
    const int x = static_cast<int>(std::floor(at.x + radius * turn.cos));
    const int y = static_cast<int>(std::floor(at.y + radius * turn.sin));
    if (x < 0 || y < 0 || x >= grey.cols || y >= grey.rows) continue;
    sum += grey(y, x);
    darkest = std::min<int>(darkest, grey(y, x));
    ++seen;
  }
  if (seen < kSamples * 3 / 4) return std::nullopt;
  return Surroundings{sum / seen, darkest};
}

// The centre of what is darker than the ground.
Point centre_of(const cv::Mat1b& grey, Point at, double radius, int ground) {
  double weight = 0, x_sum = 0, y_sum = 0;
  const int reach = static_cast<int>(std::ceil(1.25 * radius));
  for (int y = static_cast<int>(at.y) - reach; y <= static_cast<int>(at.y) + reach; ++y)
    for (int x = static_cast<int>(at.x) - reach; x <= static_cast<int>(at.x) + reach; ++x) {
      if (x < 0 || y < 0 || x >= grey.cols || y >= grey.rows) continue;
      const double darker = std::max(0, ground - kContrast / 4 - grey(y, x));
      weight += darker;
      x_sum += darker * (x + 0.5);
      y_sum += darker * (y + 0.5);
    }
  return weight > 0 ? Point{x_sum / weight, y_sum / weight} : at;
}

std::optional<Marker> marker_of(const cv::Mat1b& grey, const std::vector<cv::Point>& outline, double mm_per_px) {
  const cv::Rect box = cv::boundingRect(outline);
  const double diameter = (box.width + box.height) / 2.0, slack = kRoundness * diameter + 1;
  if (diameter * mm_per_px < kLeastMm || diameter * mm_per_px > kMostMm) return std::nullopt;
  if (std::abs(box.width - box.height) > slack) return std::nullopt;
  // Of a contour through pixels' centres: a disc smaller by half a pixel all around.
  const double area = cv::contourArea(outline), expected = kPi / 4 * (diameter - 1) * (diameter - 1);
  if (std::abs(std::sqrt(area / expected) - 1) > kRoundness / 2 + 1 / diameter) return std::nullopt;
  const Point middle{box.x + box.width / 2.0, box.y + box.height / 2.0};
  const auto ground = around(grey, middle, 0.65 * diameter + 1), inside = around(grey, middle, 0.38 * diameter);
  if (!ground || !inside || ground->darkest - inside->mean < kContrast) return std::nullopt;
  return Marker{centre_of(grey, middle, diameter / 2, ground->mean), diameter};
}

// The most that are of one size.
std::vector<Marker> alike(std::vector<Marker> all) {
  std::sort(all.begin(), all.end(), [](const Marker& a, const Marker& b) { return a.diameter < b.diameter; });
  std::vector<Marker> best;
  for (std::size_t first = 0; first < all.size(); ++first) {
    std::size_t end = first;
    while (end < all.size() && all[end].diameter <= (1 + kRoundness) * all[first].diameter + 1) ++end;
    if (end - first > best.size())
      best.assign(all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return best;
}

}  // namespace

std::vector<Marker> find_markers(const cv::Mat3b& rgb, double mm_per_px) {
  cv::Mat1b grey, dark;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  std::vector<Marker> found;
  // A mark stands out at one of these at least.
  for (const int threshold : {64, 112, 160}) {
    dark = grey < threshold;
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(dark, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    for (const auto& outline : outlines) {
      const auto marker = marker_of(grey, outline, mm_per_px);
      if (!marker) continue;
      const auto is_known = [&](const Marker& m) { return length(m.at - marker->at) < m.diameter; };
      if (std::none_of(found.begin(), found.end(), is_known)) found.push_back(*marker);
    }
  }
  std::vector<Marker> markers = alike(std::move(found));
  if (markers.size() < kFewest) return {};
  std::sort(markers.begin(), markers.end(),
            [](const Marker& a, const Marker& b) { return a.at.y != b.at.y ? a.at.y < b.at.y : a.at.x < b.at.x; });
  return markers;
}

}  // namespace tessera::parquetry

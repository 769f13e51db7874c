#include "tessera/pebbles/rims.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tessera/pebbles/neighbours.h"

namespace tessera::pebbles {
namespace {

constexpr double kBodyShare = 0.3;  // of a label's pixels are darker than its body's lightness
constexpr double kNearer = 0.4;     // of the way from gap to body: where the pebble begins
constexpr int kFaintest = 4,
              kFaintestShare = 6;  // levels, and one part in so many of the body's: what is less dark is shade

// The lightness that a share of each label's pixels does not exceed.
std::vector<int> body_lightness(const cv::Mat1b& lightness, const cv::Mat1i& labels, int count) {
  std::vector<std::size_t> start(count + 2, 0);
  for (const int label : labels) ++start[label + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::uint8_t> levels(labels.total());  // label by label
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) levels[next[labels(y, x)]++] = lightness(y, x);
  std::vector<int> body(count + 1, 0);
  for (int label = 1; label <= count; ++label) {
    const auto first = levels.begin() + static_cast<std::ptrdiff_t>(start[label]);
    const auto last = levels.begin() + static_cast<std::ptrdiff_t>(start[label + 1]);
    if (first == last) continue;
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(kBodyShare * static_cast<double>(last - first))) - 1;
    std::nth_element(first, first + rank, last);
    body[label] = first[rank];
  }
  return body;
}

// How much darker than the body a gap is at least.
int least_darkness(int body) { return std::max(kFaintest, body / kFaintestShare); }

// Floods each label from its border; the flood remembers the darkest it has come through.
void flood_rims(const cv::Mat1b& lightness, const std::vector<int>& body, cv::Mat1i& labels) {
  struct Wave {
    int y, x, darkest;
  };
  std::vector<Wave> waves;
  cv::Mat1b wet(labels.size(), std::uint8_t{0});
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels(y, x);
      if (label == 0 || lightness(y, x) + least_darkness(body[label]) >= body[label]) continue;
      bool at_border = false;
      each_neighbour(labels, y, x, [&](int v, int u) { at_border |= labels(v, u) != label; });
      if (!at_border) continue;
      wet(y, x) = 1;
      waves.push_back({y, x, lightness(y, x)});
    }
  for (std::size_t k = 0; k < waves.size(); ++k) {
    const Wave wave = waves[k];
    const int label = labels(wave.y, wave.x);
    each_neighbour(labels, wave.y, wave.x, [&](int v, int u) {
      if (wet(v, u) || labels(v, u) != label) return;
      const int darkest = std::min<int>(wave.darkest, lightness(v, u)), rise = body[label] - darkest;
      if (rise <= least_darkness(body[label]) || lightness(v, u) >= darkest + kNearer * rise) return;
      wet(v, u) = 1;
      waves.push_back({v, u, darkest});
    });
  }
  for (const Wave& wave : waves) labels(wave.y, wave.x) = 0;
}

}  // namespace

void trim_rims(const cv::Mat3b& lab, cv::Mat1i& labels) {
  const int count = largest_label(labels);
  cv::Mat1b lightness;
  cv::extractChannel(lab, lightness, 0);
  cv::medianBlur(lightness.clone(), lightness, 3);
  flood_rims(lightness, body_lightness(lightness, labels, count), labels);
  keep_largest_parts(labels, count);
}

}  // namespace tessera::pebbles

#include "tessera/parquetry/features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tessera/image/lab.h"

namespace tessera::parquetry {
namespace {

struct Weights {
  double intensity, edge, colour;
};

// So that the largest is 1.
Weights normalised(const Params& params) {
  const double largest = std::max({params.weight_intensity, params.weight_edge, params.weight_colour});
  if (largest <= 0) return {0, 0, 0};
  return {params.weight_intensity / largest, params.weight_edge / largest, params.weight_colour / largest};
}

// Levels scaled about `middle`.
Tones scaled(double weight, int middle) {
  Tones tones;
  for (int level = 0; level < 256; ++level)
    tones[level] = static_cast<std::uint8_t>(middle + std::lround(weight * (level - middle)));
  return tones;
}

Tones after(const Tones& first, const Tones& then) {
  Tones both;
  for (int level = 0; level < 256; ++level) both[level] = then[first[level]];
  return both;
}

// One channel into the interleaved features; the source has `channels` of them.
void fill(const cv::Mat& from, int channel, const Tones& tones, cv::Mat& features, int to) {
  const std::ptrdiff_t in = from.channels(), out = features.channels();
  for (int y = 0; y < features.rows; ++y) {
    const std::uint8_t* source = from.ptr(y) + channel;
    std::uint8_t* row = features.ptr(y) + to;
    for (int x = 0; x < features.cols; ++x) row[x * out] = tones[source[x * in]];
  }
}

}  // namespace

cv::Mat1b intensity_of(const cv::Mat3b& rgb) {
  cv::Mat1b grey(rgb.size());
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const cv::Vec3b& p = rgb(y, x);
      grey(y, x) = static_cast<std::uint8_t>((77 * p[0] + 150 * p[1] + 29 * p[2] + 128) >> 8);
    }
  return grey;
}

cv::Mat1b edges_of(const cv::Mat1b& intensity) {
  cv::Mat1b edges(intensity.size());
  cv::parallel_for_({0, intensity.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      const std::uint8_t* above = intensity.ptr(std::max(0, y - 1));
      const std::uint8_t* here = intensity.ptr(y);
      const std::uint8_t* below = intensity.ptr(std::min(intensity.rows - 1, y + 1));
      for (int x = 0; x < intensity.cols; ++x) {
        const int l = std::max(0, x - 1), r = std::min(intensity.cols - 1, x + 1);
        const int across = above[r] - above[l] + 2 * (here[r] - here[l]) + below[r] - below[l];
        const int down = below[l] - above[l] + 2 * (below[x] - above[x]) + below[r] - above[r];
        // Of whole numbers below 2^24: exact before the root, which is rounded alike everywhere.
        const float magnitude = std::sqrt(static_cast<float>(across * across + down * down));
        edges(y, x) = static_cast<std::uint8_t>(std::min(255, static_cast<int>(0.25f * (magnitude + 2))));
      }
    }
  });
  return edges;
}

Histogram histogram_of(const cv::Mat1b& levels, const cv::Mat1b& mask) {
  Histogram counts{};
  for (int y = 0; y < levels.rows; ++y)
    for (int x = 0; x < levels.cols; ++x)
      if (mask.empty() || mask(y, x) != 0) ++counts[levels(y, x)];
  return counts;
}

Tones matched_tones(const Histogram& target, const Histogram& wood, double weight) {
  std::int64_t target_pixels = 0, wood_pixels = 0;
  for (int level = 0; level < 256; ++level) {
    target_pixels += target[level];
    wood_pixels += wood[level];
  }
  if (target_pixels == 0 || wood_pixels == 0) return scaled(1, 0);
  Tones tones;
  std::int64_t below = 0, wood_below = wood[0];
  int matched = 0;
  for (int level = 0; level < 256; ++level) {
    // The middle of the level's pixels in the order of their levels, as a share of all; the first level of the wood
    // that reaches it. Twice the ranks, to stay with whole numbers.
    const std::int64_t rank = 2 * below + target[level];
    below += target[level];
    while (matched < 255 && static_cast<double>(2 * wood_below) * static_cast<double>(target_pixels) <
                                static_cast<double>(rank) * static_cast<double>(wood_pixels))
      wood_below += wood[++matched];
    tones[level] = static_cast<std::uint8_t>(std::lround((1 - weight) * level + weight * matched));
  }
  return tones;
}

int feature_channels(const Params& params) {
  return std::max(1,
                  int{params.weight_intensity > 0} + int{params.weight_edge > 0} + 2 * int{params.weight_colour > 0});
}

cv::Mat features_of(const cv::Mat3b& rgb, const Params& params, const Tones* tones) {
  const Weights weights = normalised(params);
  cv::Mat features(rgb.size(), CV_8UC(feature_channels(params)), cv::Scalar::all(0));
  int channel = 0;
  const cv::Mat1b intensity = intensity_of(rgb);
  if (weights.intensity > 0) {
    const Tones own = scaled(weights.intensity, 0);
    fill(intensity, 0, tones ? after(*tones, own) : own, features, channel++);
  }
  if (weights.edge > 0) fill(edges_of(intensity), 0, scaled(weights.edge, 0), features, channel++);
  if (weights.colour > 0) {
    const cv::Mat3b lab = lab_of(rgb);
    for (const int axis : {1, 2}) fill(lab, axis, scaled(weights.colour, 128), features, channel++);
  }
  return features;
}

}  // namespace tessera::parquetry

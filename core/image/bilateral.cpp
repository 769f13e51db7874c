#include "tessera/image/bilateral.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace tessera {
namespace {

constexpr double kReach = 2;     // sigmas; beyond that nothing counts
constexpr int kNearest = 256;    // weight of the pixel itself
constexpr int kAlike = 1 << 12;  // weight of no difference

// exp(-x) but for some thousandths, by multiplications alone.
double fading(double x) {
  constexpr int kSquarings = 10;
  double value = std::max(0.0, 1 - x / (1 << kSquarings));
  for (int i = 0; i < kSquarings; ++i) value *= value;
  return value;
}

struct Neighbour {
  int dx, dy, weight;
};

std::vector<Neighbour> neighbours_within(double sigma) {
  const int reach = std::max(1, static_cast<int>(std::ceil(kReach * sigma)));
  std::vector<Neighbour> neighbours;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const int squared = dx * dx + dy * dy;
      const auto weight = static_cast<int>(std::lround(kNearest * fading(squared / (2 * sigma * sigma))));
      if (squared <= reach * reach && weight > 0) neighbours.push_back({dx, dy, weight});
    }
  return neighbours;
}

}  // namespace

cv::Mat1b joint_bilateral(const cv::Mat1b& picture, const cv::Mat1b& guide, const BilateralParams& params) {
  assert(picture.size() == guide.size() && params.sigma_px > 0 && params.sigma_levels > 0);
  const std::vector<Neighbour> neighbours = neighbours_within(params.sigma_px);
  std::array<int, 511> alike{};  // [difference + 255]
  for (int difference = -255; difference <= 255; ++difference)
    alike[difference + 255] = static_cast<int>(
        std::lround(kAlike * fading(difference * difference / (2 * params.sigma_levels * params.sigma_levels))));
  const int reach = std::max(1, static_cast<int>(std::ceil(kReach * params.sigma_px)));
  cv::Mat1b wide, wide_guide;
  cv::copyMakeBorder(picture, wide, reach, reach, reach, reach, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(guide, wide_guide, reach, reach, reach, reach, cv::BORDER_REPLICATE);
  cv::Mat1b smooth(picture.size());
  cv::parallel_for_({0, picture.rows}, [&](const cv::Range& rows) {
    std::vector<std::int64_t> weights(picture.cols), sums(picture.cols);
    for (int y = rows.start; y < rows.end; ++y) {
      weights.assign(picture.cols, 0);
      sums.assign(picture.cols, 0);
      const std::uint8_t* own = wide_guide[y + reach] + reach;
      for (const Neighbour& n : neighbours) {
        const std::uint8_t* level = wide[y + reach + n.dy] + reach + n.dx;
        const std::uint8_t* other = wide_guide[y + reach + n.dy] + reach + n.dx;
        for (int x = 0; x < picture.cols; ++x) {
          const int weight = n.weight * alike[other[x] - own[x] + 255];
          weights[x] += weight;
          sums[x] += std::int64_t{weight} * level[x];
        }
      }
      for (int x = 0; x < picture.cols; ++x)
        smooth(y, x) = static_cast<std::uint8_t>((sums[x] + weights[x] / 2) / weights[x]);
    }
  });
  return smooth;
}

cv::Mat1b rolling_guidance(const cv::Mat1b& picture, const BilateralParams& params, int rounds) {
  cv::Mat1b guide(picture.size(), static_cast<std::uint8_t>(0));
  for (int round = 0; round < rounds; ++round) guide = joint_bilateral(picture, guide, params);
  return guide;
}

}  // namespace tessera

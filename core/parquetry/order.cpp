#include "tessera/parquetry/order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "tessera/image/saliency.h"

namespace tessera::parquetry {
namespace {

std::int64_t accumulated(const cv::Mat1i& saliency, const Patch& patch) {
  std::int64_t sum = 0;
  for (int y = 0; y < patch.box.height; ++y)
    for (int x = 0; x < patch.box.width; ++x)
      if (patch.mask(y, x) != 0) sum += saliency(patch.box.y + y, patch.box.x + x);
  return sum;
}

// Four times the square of it.
std::int64_t distance_from_middle(const cv::Mat3b& target, const Patch& patch) {
  const std::int64_t x = 2 * patch.box.x + patch.box.width - target.cols;
  const std::int64_t y = 2 * patch.box.y + patch.box.height - target.rows;
  return x * x + y * y;
}

}  // namespace

std::vector<int> order_of(const std::vector<Patch>& patches, const std::vector<cv::Mat3b>& targets, Order order,
                          bool interleaved) {
  std::vector<cv::Mat1i> saliency;
  if (order == Order::kSaliency)
    for (const cv::Mat3b& target : targets) saliency.push_back(saliency_of(target));
  struct Rank {
    std::int64_t target, measure;
    bool operator<(const Rank& other) const {
      return target != other.target ? target < other.target : measure < other.measure;
    }
  };
  std::vector<Rank> ranks;
  for (const Patch& patch : patches) {
    Rank rank{interleaved ? 0 : patch.target, 0};
    switch (order) {
      case Order::kSaliency: rank.measure = -accumulated(saliency[patch.target], patch); break;
      case Order::kCentre: rank.measure = distance_from_middle(targets[patch.target], patch); break;
      case Order::kRows: rank.measure = patch.row; break;
    }
    ranks.push_back(rank);
  }
  std::vector<int> indices(patches.size());
  std::iota(indices.begin(), indices.end(), 0);
  std::stable_sort(indices.begin(), indices.end(), [&](int a, int b) { return ranks[a] < ranks[b]; });
  return indices;
}

}  // namespace tessera::parquetry

#include "tessera/pebbles/segment_tree.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tessera/image/lab.h"
#include "tessera/pebbles/distinct.h"
#include "tessera/pebbles/region_tree.h"
#include "tessera/pebbles/rims.h"
#include "tessera/pebbles/strength.h"
#include "tessera/pebbles/watershed.h"

namespace tessera::pebbles {
namespace {

constexpr int kShallow = 200;     // units of strength: basins less deep are none
constexpr double kLasting = 640;  // units of strength: how much stronger than within the border around should be
constexpr double kLargestShare = 0.25;  // of the picture: no pebble covers more
constexpr double kLeastLooks = 0.3;     // a region's score for each of its pixels

// 0 to 1: how much a region looks like a pebble. An ellipse without dents, whose border is stronger than what it was
// joined over.
double looks(const Region& region, const std::vector<Region>& regions) {
  const double area = static_cast<double>(region.moments.count);
  const double ellipticity = std::min(1.0, area / region.moments.ellipse_area());
  const double solidity = area / region.hull_area;
  const double lasting = std::max(0.0, regions[region.parent].joined_at - region.joined_at) / kLasting;
  return ellipticity * solidity * (0.5 + 0.5 * lasting / (1 + lasting));
}

// Which regions are pebbles: disjoint ones with the largest sum of area times looks, by dynamic programming from the
// basins up. A number from 1 for each basin, 0: none.
std::vector<int> choose(const std::vector<Region>& regions, int basins, std::int64_t pixels) {
  const auto largest = static_cast<std::int64_t>(kLargestShare * static_cast<double>(pixels));
  const int count = static_cast<int>(regions.size());
  std::vector<double> best(count, 0);
  std::vector<char> whole(count, 0);
  for (int r = 0; r < count; ++r) {
    const Region& region = regions[r];
    const bool possible = region.parent >= 0 && region.moments.count <= largest;
    const double own = possible ? static_cast<double>(region.moments.count) * looks(region, regions) : 0;
    const double parts = region.left >= 0 ? best[region.left] + best[region.right] : 0;
    whole[r] = own > 0 && own >= parts;
    best[r] = std::max(own, parts);
  }
  constexpr int kOpen = -1;
  std::vector<int> number(count, kOpen);
  int pebbles = 0;
  for (int r = count - 1; r >= 0; --r) {
    const Region& region = regions[r];
    if (number[r] == kOpen && whole[r]) {
      number[r] = best[r] >= kLeastLooks * static_cast<double>(region.moments.count) ? ++pebbles : 0;
    }
    if (region.left >= 0) number[region.left] = number[region.right] = number[r];
  }
  number.resize(basins);
  std::replace(number.begin(), number.end(), kOpen, 0);
  return number;
}

cv::Mat1i painted(const Basins& basins, const std::vector<int>& number) {
  cv::Mat1i labels(basins.labels.size());
  std::transform(basins.labels.begin(), basins.labels.end(), labels.begin(),
                 [&](int basin) { return number[basin]; });
  return labels;
}

}  // namespace

Result<cv::Mat1i> segment_by_tree(const cv::Mat3b& photo, const Params& params, const RunContext& context) {
  const cv::Mat3b lab = lab_of(photo);
  const cv::Mat1w strength = border_strength(lab);
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  context.progress(0.2);
  const Basins basins = watershed(strength, kShallow);
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  context.progress(0.35);
  const std::vector<Region> regions = region_tree(basins, strength);
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  context.progress(0.45);
  cv::Mat1i labels = painted(basins, choose(regions, basins.count, static_cast<std::int64_t>(photo.total())));
  trim_rims(lab, labels);
  drop_indistinct(lab, params, labels);
  return labels;
}

}  // namespace tessera::pebbles

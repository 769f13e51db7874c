#include "tessera/parquetry/edge_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "tessera/image/bilateral.h"
#include "tessera/image/edges.h"
#include "tessera/image/resample.h"
#include "tessera/parquetry/features.h"

namespace tessera::parquetry {
namespace {

constexpr int kPxPerCell = 20;
constexpr int kRounds = 4;                                 // of the rolling guidance filter, as its authors
constexpr double kSmall = 0.1, kTiny = 0.05;               // of a cell: sigmas of the two filters
constexpr double kLevels = 25;                             // a tenth of the range, as the filter's authors
constexpr double kLargeShare = 0.12, kFineShare = 0.06;    // of the pixels: whose gradients may begin an edge
constexpr double kShortestLarge = 0.5, kShortestFine = 1;  // of a cell

cv::Mat1b edges_in(const cv::Mat1b& smooth, double share, double shortest) {
  cv::Mat3b three;
  cv::cvtColor(smooth, three, cv::COLOR_GRAY2RGB);
  return find_edges(three, {0.7, share, shortest});
}

// Eq. 5's Hadamard product.
cv::Mat1b masked(const cv::Mat1b& edges, const cv::Mat1b& mask) {
  if (mask.empty()) return edges;
  cv::Mat1b stretched;
  cv::resize(mask, stretched, edges.size(), 0, 0, cv::INTER_NEAREST);
  return edges & (stretched != 0);
}

}  // namespace

Result<EdgeMasks> edge_masks_of(const ImageView& picture, cv::Size target) {
  if (!picture.pixels) return EdgeMasks{};
  if (!has_proportions(picture, target))
    return fail(StatusCode::kInvalidInput, "edge-mask",
                fmt::format("is {} x {}, expected the target's proportions, {} to {}", picture.width, picture.height,
                            target.width, target.height));
  std::vector<cv::Mat1b> channels;
  cv::split(picture.mat(), channels);
  return EdgeMasks{channels[0] >= 128, channels[2] >= 128};
}

FoundEdges edges_of(const cv::Mat3b& target, const Grid& grid) {
  const cv::Mat3b picture = shrunk({target.data, target.cols, target.rows, static_cast<std::ptrdiff_t>(target.step)},
                                   std::max(1, kPxPerCell * grid.across()));
  const cv::Mat1b levels = intensity_of(picture);  // what of the picture wood can show
  const double cell = static_cast<double>(picture.cols) / grid.across();
  return {edges_in(rolling_guidance(levels, {kSmall * cell, kLevels}, kRounds), kLargeShare, kShortestLarge * cell),
          edges_in(joint_bilateral(levels, levels, {kTiny * cell, kLevels}), kFineShare, kShortestFine * cell)};
}

FoundEdges masked(const FoundEdges& found, const EdgeMasks& masks) {
  return {masked(found.rolling_guidance, masks.rolling_guidance), masked(found.bilateral, masks.bilateral)};
}

EdgePicture::EdgePicture(const cv::Mat3b& target, const Grid& grid, double reach, const EdgeMasks& masks)
    : EdgePicture(masked(edges_of(target, grid), masks), target.size(), reach) {}

EdgePicture::EdgePicture(const FoundEdges& counting, cv::Size target, double reach)
    : edges_(cv::max(cv::Mat(counting.rolling_guidance), cv::Mat(counting.bilateral))) {
  px_ = {static_cast<double>(target.width) / edges_.cols, static_cast<double>(target.height) / edges_.rows};
  distance_ = edge_distance(edges_);
  // Eq. 6: edges attract what is nearer than r / 2 and push away what is nearer than r. The paper sets r to half the
  // grid's spacing; the edges in half of the grid would then attract nobody. Here it is r / 2 that is as long.
  const auto r = static_cast<float>(2 * reach / px_.x);
  potential_ = cv::Mat1f(edges_.size());
  for (int y = 0; y < edges_.rows; ++y)
    for (int x = 0; x < edges_.cols; ++x)
      potential_(y, x) = std::max(0.0F, std::min(distance_(y, x), r - distance_(y, x)));
}

double EdgePicture::distance(Point p) const { return px_.x * at(distance_, p.x / px_.x, p.y / px_.y); }

Point EdgePicture::downhill(Point p) const {
  const double x = p.x / px_.x, y = p.y / px_.y;
  return {at(potential_, x - 0.5, y) - at(potential_, x + 0.5, y),
          at(potential_, x, y - 0.5) - at(potential_, x, y + 0.5)};
}

}  // namespace tessera::parquetry

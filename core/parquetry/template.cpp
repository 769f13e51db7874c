#include "tessera/parquetry/template.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tessera::parquetry {
namespace {

// Corners of blocks of `side` px inside the mask `left`, from which they are taken: at multiples of kGroup from row
// `first` (0 <= first < kGroup) on.
std::vector<cv::Point> take_blocks(cv::Mat1b& left, int side, int first) {
  std::vector<cv::Point> blocks;
  for (int y = first; y + side <= left.rows; y += kGroup)
    for (int x = 0; x + side <= left.cols; x += kGroup) {
      const cv::Rect block(x, y, side, side);
      if (cv::countNonZero(left(block)) != block.area()) continue;
      left(block).setTo(0);
      blocks.push_back(block.tl());
    }
  return blocks;
}

// The lowest first.
std::vector<int> upwards(int rows) {
  std::vector<int> order(rows);
  for (int k = 0; k < rows; ++k) order[k] = rows - 1 - k;
  return order;
}

Stencil pixels_of(const cv::Mat& features, const cv::Mat1b& mask, std::vector<int> rows) {
  const int channels = features.channels();
  Stencil stencil(std::move(rows), mask.cols * channels);
  for (int k = 0; k < stencil.rows(); ++k) {
    const int y = stencil.order[k];
    for (int i = 0; i < mask.cols * channels; ++i)
      if (mask(y, i / channels) != 0) stencil.set(k, i, features.ptr(y)[i]);
  }
  return stencil;
}

std::vector<std::uint8_t> moments_of_blocks(const cv::Mat& features, const std::vector<Block>& blocks,
                                            const ByteCode& code) {
  std::vector<std::uint8_t> bytes;
  const auto append = [&](double v) {
    bytes.push_back(static_cast<std::uint8_t>(std::floor(v)));
    bytes.push_back(static_cast<std::uint8_t>(std::ceil(v)));
  };
  for (const Block& block : blocks)
    for (int c = 0; c < features.channels(); ++c) {
      const Moments moments = moments_of(features, c, block.box());
      append(code.mean(moments.mean, c));
      append(code.deviation(moments.deviation));
    }
  return bytes;
}

Template::Coarse coarse_part(const cv::Mat& features, const cv::Mat1b& mask, const ByteCode& code) {
  Template::Coarse coarse;
  coarse.blocks = coarse_blocks(mask);
  for (int i = 0; i < static_cast<int>(coarse.blocks.size()); ++i) {
    const int bottom = coarse.blocks[i].box().br().y;
    if (coarse.bottoms.empty() || coarse.bottoms.back() != bottom) {
      coarse.bottoms.push_back(bottom);
      coarse.bands.push_back(0);
    }
    coarse.bands.back() = i + 1;
  }
  coarse.moments = moments_of_blocks(features, coarse.blocks, code);
  return coarse;
}

// What rounding loses of blocks' bytes: of the patch's as it is, of the frame's at most half a byte each.
class Lost {
 public:
  void add(double exact, double byte) {
    own_ += (exact - byte) * (exact - byte);
    ++count_;
  }
  double distance() const { return std::sqrt(own_) + kMostRounded * std::sqrt(static_cast<double>(count_)); }

 private:
  static constexpr double kMostRounded = 0.5 + 1e-3;
  double own_ = 0;
  int count_ = 0;
};

// At a position `off` rows from the first of its group: blocks of the frame begin at multiples of kGroup.
Template::Fine fine_blocks(const cv::Mat& features, const cv::Mat1b& mask, int off, const ByteCode& code,
                           const Template::Coarse& coarse) {
  const int first = (kGroup - off) % kGroup, statistics = 2 * code.channels;
  const int block_rows = std::max(0, mask.rows - first) / kGroup, skipped = (off + first) / kGroup;
  std::vector<int> order = upwards(block_rows);
  for (int& row : order) row += skipped;
  Template::Fine fine;
  Stencil& stencil = fine.blocks = Stencil(std::move(order), mask.cols / kGroup * statistics);
  const int all_looks = looks(block_rows);
  std::vector<Lost> lost(all_looks), rest(all_looks + 1);
  cv::Mat1b left = mask.clone();
  for (const cv::Point block : take_blocks(left, kGroup, first)) {
    const int k = block_rows - 1 - (block.y - first) / kGroup;
    for (int s = 0; s < statistics; ++s) {
      const Moments moments = moments_of(features, s / 2, {block, cv::Size(kGroup, kGroup)});
      const double exact = s % 2 == 0 ? code.mean(moments.mean, s / 2) : code.deviation(moments.deviation);
      const double byte = std::floor(exact + 0.5);
      stencil.set(k, block.x / kGroup * statistics + s, static_cast<std::uint8_t>(byte));
      for (int look = k / kLook; look < all_looks; ++look) lost[look].add(exact, byte);
      for (int look = 0; look <= k / kLook; ++look) rest[look].add(exact, byte);
    }
  }
  for (const Lost& each : lost) fine.lost.push_back(each.distance());
  for (const Lost& each : rest) fine.lost_rest.push_back(each.distance());
  const auto top = [&](int look) { return first + kGroup * std::max(0, block_rows - kLook * look); };
  for (int look = 1; look <= all_looks; ++look)
    fine.bands_above.push_back(static_cast<int>(
        std::upper_bound(coarse.bottoms.begin(), coarse.bottoms.end(), top(look)) - coarse.bottoms.begin()));
  for (int seen = kLook, look = 0; seen < mask.rows + kLook; seen += kLook) {
    while (look < all_looks && top(look) > std::max(0, mask.rows - seen)) ++look;
    fine.looks.push_back(look);
  }
  std::vector<int> others;
  for (const int y : upwards(mask.rows))
    if (y < first || y >= top(0)) others.push_back(y);
  fine.strips = pixels_of(features, mask, std::move(others));
  return fine;
}

}  // namespace

std::vector<Block> coarse_blocks(const cv::Mat1b& mask) {
  // Larger blocks are fewer, smaller ones leave less at the border: the next smaller ones follow until most of what
  // the smallest cover is covered.
  constexpr double kEnough = 0.75;
  cv::Mat1b left = mask.clone();
  const double most = kGroup * kGroup * static_cast<double>(take_blocks(left, kGroup, 0).size());
  double covered = 0;
  std::vector<Block> blocks;
  left = mask.clone();
  for (const int side : {16, 8, 4}) {
    for (const cv::Point at : take_blocks(left, side, 0)) blocks.push_back({at / kGroup, side});
    covered = std::accumulate(blocks.begin(), blocks.end(), 0.0,
                              [](double sum, const Block& block) { return sum + block.box().area(); });
    if (covered >= kEnough * most) break;
  }
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const Block& a, const Block& b) { return a.box().br().y < b.box().br().y; });
  return blocks;
}

Template make_template(const Patch& patch, const cv::Mat& features, const ByteCode& code, double half_kerf) {
  Template made;
  made.shape = shape_of(patch, half_kerf);
  const cv::Mat own = features(patch.box);
  made.pixels = pixels_of(own, patch.mask, upwards(patch.mask.rows));
  made.coarse = coarse_part(own, patch.mask, code);
  for (int off = 0; off < kGroup; ++off) made.fine[off] = fine_blocks(own, patch.mask, off, code, made.coarse);
  return made;
}

}  // namespace tessera::parquetry

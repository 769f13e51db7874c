#include "tessera/parquetry/template.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tessera::parquetry {
namespace {

bool all_inside(const cv::Mat1b& mask, cv::Rect block) {
  return (block & cv::Rect({0, 0}, mask.size())) == block && cv::countNonZero(mask(block)) == block.area();
}

Stencil pixels_of(const cv::Mat& features, const cv::Mat1b& mask, std::vector<int> rows) {
  const int channels = features.channels();
  Stencil stencil(std::move(rows), mask.cols * channels);
  for (std::size_t k = 0; k < stencil.order.size(); ++k) {
    const int y = stencil.order[k];
    for (int i = 0; i < mask.cols * channels; ++i) {
      if (mask(y, i / channels) == 0) continue;
      stencil.row(static_cast<int>(k))[i] = features.ptr(y)[i];
      stencil.mask_row(static_cast<int>(k))[i] = 255;
    }
  }
  return stencil;
}

std::vector<std::uint8_t> moments_of_blocks(const cv::Mat& features, const std::vector<cv::Point>& blocks, int side,
                                            const ByteCode& code) {
  std::vector<std::uint8_t> bytes;
  const auto append = [&](double v) {
    bytes.push_back(static_cast<std::uint8_t>(std::floor(v)));
    bytes.push_back(static_cast<std::uint8_t>(std::ceil(v)));
  };
  for (const cv::Point block : blocks)
    for (int c = 0; c < features.channels(); ++c) {
      const Moments moments = moments_of(features, c, {kGroup * block, cv::Size(side, side)});
      append(code.mean(moments.mean, c));
      append(code.deviation(moments.deviation));
    }
  return bytes;
}

// At a position `off` rows from the first of its group: blocks of the frame begin at multiples of kGroup.
Template::Fine fine_blocks(const cv::Mat& features, const cv::Mat1b& mask, int off, const ByteCode& code) {
  constexpr double kMostRounded = 0.5 + 1e-3;
  const int first = (kGroup - off) % kGroup, statistics = 2 * code.channels;
  const int block_rows = std::max(0, mask.rows - first) / kGroup, skipped = (off + first) / kGroup;
  Template::Fine fine;
  std::vector<int> order = spread_rows(block_rows);
  std::vector<int> place(block_rows);
  for (int k = 0; k < block_rows; ++k) {
    place[order[k]] = k;
    order[k] += skipped;
  }
  Stencil& stencil = fine.blocks = Stencil(std::move(order), mask.cols / kGroup * statistics);
  double own = 0;
  int count = 0;
  for (const cv::Point block : blocks_inside(mask, kGroup, first)) {
    const int k = place[(block.y - first) / kGroup];
    for (int s = 0; s < statistics; ++s) {
      const Moments moments = moments_of(features, s / 2, {block, cv::Size(kGroup, kGroup)});
      const double exact = s % 2 == 0 ? code.mean(moments.mean, s / 2) : code.deviation(moments.deviation);
      const double byte = std::floor(exact + 0.5);
      stencil.row(k)[block.x / kGroup * statistics + s] = static_cast<std::uint8_t>(byte);
      stencil.mask_row(k)[block.x / kGroup * statistics + s] = 255;
      own += (exact - byte) * (exact - byte);
      ++count;
    }
  }
  fine.lost = std::sqrt(own) + kMostRounded * std::sqrt(static_cast<double>(count));
  std::vector<int> others;
  for (int y = 0; y < mask.rows; ++y)
    if (y < first || y >= first + block_rows * kGroup) others.push_back(y);
  fine.strips = pixels_of(features, mask, std::move(others));
  return fine;
}

}  // namespace

std::vector<cv::Point> blocks_inside(const cv::Mat1b& mask, int side, int first) {
  std::vector<cv::Point> blocks;
  cv::Mat1b rest = mask.clone();
  for (int y = first; y + side <= mask.rows; y += kGroup)
    for (int x = 0; x + side <= mask.cols; x += kGroup) {
      const cv::Rect block(x, y, side, side);
      if (!all_inside(rest, block)) continue;
      rest(block).setTo(0);
      blocks.push_back(block.tl());
    }
  return blocks;
}

int coarse_side(const cv::Mat1b& mask) {
  // Larger blocks are fewer, smaller ones leave less at the border: of those that cover most of what any cover.
  std::array<double, kCoarseSides.size()> covered;
  for (std::size_t i = 0; i < kCoarseSides.size(); ++i)
    covered[i] = static_cast<double>(kCoarseSides[i] * kCoarseSides[i]) *
                 static_cast<double>(blocks_inside(mask, kCoarseSides[i], 0).size());
  constexpr double kEnough = 0.75;
  const double most = *std::max_element(covered.begin(), covered.end());
  for (std::size_t i = 0; i < kCoarseSides.size(); ++i)
    if (covered[i] >= kEnough * most) return kCoarseSides[i];
  return kCoarseSides.back();
}

Template make_template(const Patch& patch, const cv::Mat& features, const ByteCode& code, double half_kerf) {
  Template made;
  made.shape = shape_of(patch, half_kerf);
  const cv::Mat own = features(patch.box);
  made.pixels = pixels_of(own, patch.mask, spread_rows(patch.mask.rows));
  made.side = coarse_side(patch.mask);
  for (const cv::Point block : blocks_inside(patch.mask, made.side, 0))
    made.blocks.emplace_back(block.x / kGroup, block.y / kGroup);
  made.moments = moments_of_blocks(own, made.blocks, made.side, code);
  for (int off = 0; off < kGroup; ++off) made.fine[off] = fine_blocks(own, patch.mask, off, code);
  return made;
}

}  // namespace tessera::parquetry

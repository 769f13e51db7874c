#include "tessera/job/recorder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tessera {
namespace {

constexpr double kLongestSide = 800;  // px
constexpr int kMostFrames = 60;

// Where the n-th of `parts` equal parts of `length` has its middle.
int middle(int n, int parts, int length) {
  return std::min(length - 1, static_cast<int>((n + 0.5) * length / parts));
}

// Labels at the frame's pixels.
LabelMap sampled(const LabelMap& labels, int width, int height) {
  LabelMap few(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) few(y, x) = labels(middle(y, height, labels.rows), middle(x, width, labels.cols));
  return few;
}

using Sums = std::array<std::uint64_t, 4>;  // red, green, blue, number of pixels

}  // namespace

Recorder::Recorder(const ImageView& source) : source_(source) {
  const double scale = std::min(1.0, kLongestSide / std::max(source.width, source.height));
  width_ = std::max(1, static_cast<int>(std::lround(source.width * scale)));
  height_ = std::max(1, static_cast<int>(std::lround(source.height * scale)));
}

void Recorder::record(const Iteration& iteration) {
  const int every = iteration.last / (kMostFrames - 1) + 1;
  if (iteration.index % every != 0 && iteration.index != iteration.last) return;
  const LabelMap labels = sampled(iteration.labels, width_, height_);
  const cv::Mat3b picture = source_.mat();
  std::vector<Sums> sums(iteration.sites.size() + 1);  // the last one is that of pixels without a site
  const auto cell_at = [&](int x, int y) {
    const int label = labels(y, x);
    return label == kUnlabelled ? sums.size() - 1 : static_cast<std::size_t>(label);
  };
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const cv::Vec3b colour = picture(middle(y, height_, picture.rows), middle(x, width_, picture.cols));
      Sums& sum = sums[cell_at(x, y)];
      for (int c = 0; c < 3; ++c) sum[c] += colour[c];
      ++sum[3];
    }
  Raster frame{width_, height_, 3, 8, {}};
  frame.bytes.reserve(3 * static_cast<std::size_t>(width_) * height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const std::size_t cell = cell_at(x, y);
      const bool at_border =
          cell != cell_at(std::min(x + 1, width_ - 1), y) || cell != cell_at(x, std::min(y + 1, height_ - 1));
      for (int c = 0; c < 3; ++c) {
        const std::uint64_t mean = sums[cell][c] / sums[cell][3];
        frame.bytes.push_back(static_cast<std::uint8_t>(at_border ? mean * 5 / 8 : mean));
      }
    }
  frames_.push_back(std::move(frame));
}

}  // namespace tessera

#include "tessera/job/recorder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tessera {
namespace {

constexpr double kLongestSide = 800;  // px
constexpr std::size_t kMostFrames = 60, kMostBytes = 54'000'000;

// Where the n-th of `parts` equal parts of `length` has its middle.
int middle(int n, int parts, int length) {
  return std::min(length - 1, static_cast<int>((n + 0.5) * length / parts));
}

template <class T>
cv::Mat_<T> sampled(const cv::Mat_<T>& all, cv::Size size) {
  std::vector<int> columns(size.width);
  for (int x = 0; x < size.width; ++x) columns[x] = middle(x, size.width, all.cols);
  cv::Mat_<T> few(size);
  for (int y = 0; y < size.height; ++y) {
    const T* from = all[middle(y, size.height, all.rows)];
    std::transform(columns.begin(), columns.end(), few[y], [&](int column) { return from[column]; });
  }
  return few;
}

cv::Size frame_size(const ImageView& source) {
  const double scale = std::min(1.0, kLongestSide / std::max(source.width, source.height));
  const auto scaled = [&](int length) { return std::max(1, static_cast<int>(std::lround(length * scale))); };
  return {scaled(source.width), scaled(source.height)};
}

// How many frames of so many pixels.
int most_frames(std::size_t pixels) {
  return static_cast<int>(std::clamp<std::size_t>(kMostBytes / (pixels * sizeof(int)), 2, kMostFrames));
}

using Sums = std::array<std::uint64_t, 4>;  // red, green, blue, number of pixels

}  // namespace

Recorder::Recorder(const ImageView& source) : source_(sampled<cv::Vec3b>(source.mat(), frame_size(source))) {}

void Recorder::record(const Iteration& iteration) {
  const int steps = most_frames(source_.total()) - 1;
  const int every = std::max(1, (iteration.last + steps - 1) / steps);
  if (iteration.index % every == 0 || iteration.index == iteration.last) keep(iteration);
}

void Recorder::keep(const Iteration& iteration) {
  recorded_.push_back({sampled<int>(iteration.labels, source_.size()), iteration.sites.size()});
}

Raster Recorder::draw(const ImageView& source, const Iteration& iteration) {
  Recorder recorder(source);
  recorder.keep(iteration);
  return recorder.frame(0);
}

Raster Recorder::frame(int index) const {
  const auto& [labels, sites] = recorded_[static_cast<std::size_t>(index)];
  const int width = source_.cols, height = source_.rows;
  const auto cell_at = [&labels = labels, none = sites](int x, int y) {
    const int label = labels(y, x);
    return label == kUnlabelled ? none : static_cast<std::size_t>(label);
  };
  std::vector<Sums> sums(sites + 1);  // the last one is that of pixels without a site
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Sums& sum = sums[cell_at(x, y)];
      for (int c = 0; c < 3; ++c) sum[c] += source_(y, x)[c];
      ++sum[3];
    }
  Raster frame{width, height, 3, 8, {}};
  frame.bytes.reserve(3 * static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t cell = cell_at(x, y);
      const bool at_border =
          cell != cell_at(std::min(x + 1, width - 1), y) || cell != cell_at(x, std::min(y + 1, height - 1));
      for (int c = 0; c < 3; ++c) {
        const std::uint64_t mean = sums[cell][c] / sums[cell][3];
        frame.bytes.push_back(static_cast<std::uint8_t>(at_border ? mean * 5 / 8 : mean));
      }
    }
  return frame;
}

}  // namespace tessera

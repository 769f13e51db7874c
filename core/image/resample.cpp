#include "tessera/image/resample.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tessera {
namespace {

constexpr int kOne = 1 << 12;  // weights of a target pixel's sources add up to this

// The sources of each target pixel along one axis: from `first` on, as many as there are weights.
struct Span {
  int first;
  std::vector<int> weights;
};

// How many parts of kOne of each of `count` target pixels each of `size` source pixels is: the overlap of the two
// intervals. What lies beyond the last source pixel is that one again.
std::vector<Span> spans(Ratio step, int size, int count) {
  std::vector<Span> out(static_cast<std::size_t>(count));
  for (std::int64_t t = 0; t < count; ++t) {
    const std::int64_t begin = t * step.over, end = begin + step.over;  // in parts, `under` of them to a source pixel
    Span& span = out[static_cast<std::size_t>(t)];
    span.first = static_cast<int>(std::min<std::int64_t>(begin / step.under, size - 1));
    std::int64_t before = 0;
    for (std::int64_t s = span.first; before < kOne; ++s) {
      const std::int64_t last = s + 1 < size ? std::min((s + 1) * step.under, end) : end;
      span.weights.push_back(static_cast<int>((last - begin) * kOne / step.over - before));  // rounded as a whole
      before = (last - begin) * kOne / step.over;
    }
  }
  return out;
}

}  // namespace

cv::Mat3b shrunk(const ImageView& picture, int width) {
  if (picture.width <= width) return picture.mat().clone();
  const auto rounded = (2 * std::int64_t{picture.height} * width + picture.width) / (2 * std::int64_t{picture.width});
  const int height = std::max(1, static_cast<int>(rounded));
  return resampled(picture, {picture.width, width}, {picture.height, height}, {width, height});
}

cv::Mat3b resampled(const ImageView& picture, Ratio across, Ratio down, cv::Size size) {
  const std::vector<Span> columns = spans(across, picture.width, size.width),
                          rows = spans(down, picture.height, size.height);
  const cv::Mat3b source = picture.mat();
  constexpr std::int64_t kAll = std::int64_t{kOne} * kOne;
  cv::Mat3b out(size);
  cv::parallel_for_({0, size.height}, [&](const cv::Range& range) {
    std::vector<int> line(3 * static_cast<std::size_t>(source.cols));
    for (int y = range.start; y < range.end; ++y) {
      std::fill(line.begin(), line.end(), 0);
      for (std::size_t k = 0; k < rows[y].weights.size(); ++k) {
        const std::uint8_t* from = source.ptr<std::uint8_t>(rows[y].first + static_cast<int>(k));
        for (std::size_t i = 0; i < line.size(); ++i) line[i] += rows[y].weights[k] * from[i];
      }
      for (int x = 0; x < size.width; ++x)
        for (int c = 0; c < 3; ++c) {
          std::int64_t sum = 0;
          for (std::size_t k = 0; k < columns[x].weights.size(); ++k)
            sum += std::int64_t{columns[x].weights[k]} * line[3 * (columns[x].first + k) + c];
          out(y, x)[c] = static_cast<std::uint8_t>((sum + kAll / 2) / kAll);
        }
    }
  });
  return out;
}

}  // namespace tessera

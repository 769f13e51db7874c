// Rows of bytes that begin and end where something is: a turned panel leaves most corners of its box empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tessera::parquetry {

struct Span {
  int begin = 0, end = 0;
};

// `planes` of rows of elements of `width` bytes, for each row those of its span. Elements outside may be read, but
// mean nothing.
class Rows {
 public:
  Rows() = default;
  // `around`: no element further than this many outside a row's span is ever read.
  Rows(const std::vector<Span>& spans, int width, int around, int planes = 1) : width_(width) {
    const auto margin = static_cast<std::ptrdiff_t>(around) * width + kPadding;
    std::ptrdiff_t next = margin;
    starts_.reserve(spans.size());
    for (const Span& span : spans) {
      starts_.push_back(next - static_cast<std::ptrdiff_t>(span.begin) * width);
      next += static_cast<std::ptrdiff_t>(span.end - span.begin) * width;
    }
    plane_ = next + margin;
    bytes_.resize(static_cast<std::size_t>(plane_) * planes);
  }

  std::uint8_t* at(int y, int x, int plane = 0) { return bytes_.data() + plane * plane_ + starts_[y] + x * width_; }
  const std::uint8_t* at(int y, int x, int plane = 0) const {
    return bytes_.data() + plane * plane_ + starts_[y] + x * width_;
  }
  // Where row y would have its element 0, from data().
  const std::ptrdiff_t* starts() const { return starts_.data(); }
  const std::uint8_t* data() const { return bytes_.data(); }
  std::ptrdiff_t plane_size() const { return plane_; }
  std::size_t size() const { return bytes_.size(); }

 private:
  static constexpr std::ptrdiff_t kPadding = 64;  // a vector
  std::ptrdiff_t width_ = 0, plane_ = 0;
  std::vector<std::ptrdiff_t> starts_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace tessera::parquetry

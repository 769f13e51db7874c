// A sheet as pixels, in the lines that PNG compresses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/geometry/raster.h"

namespace tessera {

// RGB pixels that start as grout. Pieces do not overlap, so where several touch a pixel each takes its share of the
// grout that is left: no grout shines through where two pieces join. Where they do overlap, the later one lies on
// top.
class Picture {
 public:
  Picture(int width, int height, Rgb grout)
      : width_(static_cast<std::size_t>(width)),
        height_(static_cast<std::size_t>(height)),
        grout_{grout.r, grout.g, grout.b},
        covered_(width_ * height_, 0) {
    scanlines_.reserve(height_ * stride());
    scanlines_.push_back(kNoFilter);
    for (std::size_t x = 0; x < width_; ++x) scanlines_.insert(scanlines_.end(), grout_, grout_ + 3);
    scanlines_.resize(height_ * stride());
    for (std::size_t y = 1; y < height_; ++y) std::copy_n(scanline(0), stride(), &scanlines_[y * stride()]);
  }

  explicit Picture(const Raster& frame) : Picture(frame.width, frame.height, {}) {
    for (std::size_t y = 0; y < height_; ++y)
      std::copy_n(&frame.bytes[3 * y * width_], 3 * width_, &scanlines_[y * stride() + 1]);
  }

  // Lays `colour` over that share of the pixel, 0..1.
  void paint(int x, int y, Rgb colour, float share) {
    const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
    std::uint8_t& covered = covered_[row * width_ + column];
    std::uint8_t* const pixel = &scanlines_[row * stride() + 1 + 3 * column];
    const std::uint8_t fill[] = {colour.r, colour.g, colour.b};
    if (share >= 1) {
      std::copy_n(fill, 3, pixel);
      covered = 255;
      return;
    }
    const float before = static_cast<float>(covered) / 255;
    const float excess = std::max(0.0F, before + share - 1);
    const float keep = excess > 0 ? 1 - excess / before : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const float grout = grout_[k];
      pixel[k] = rounded(grout + keep * (static_cast<float>(pixel[k]) - grout) +
                         share * (static_cast<float>(fill[k]) - grout));
    }
    covered = rounded(255 * std::min(1.0F, before + share));
  }

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  std::size_t stride() const { return 1 + 3 * width_; }
  // As PNG compresses it: the filter's number, then the pixels.
  const std::uint8_t* scanline(std::size_t y) const { return &scanlines_[y * stride()]; }

 private:
  static constexpr std::uint8_t kNoFilter = 0;  // pieces are flat: repeats are found without one

  static std::uint8_t rounded(float value) {
    return static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
  }

  std::size_t width_, height_;
  std::uint8_t grout_[3];
  std::vector<std::uint8_t> covered_;  // how much of each pixel pieces cover, of 255
  std::vector<std::uint8_t> scanlines_;
};

// The same of pieces that all have one colour: how much of each pixel they cover, which is a number in a palette from
// the grout to that colour. A third of the memory, and of the time to compress it.
class Shades {
 public:
  Shades(int width, int height, Rgb grout, Rgb fill)
      : width_(static_cast<std::size_t>(width)),
        height_(static_cast<std::size_t>(height)),
        grout_(grout),
        fill_(fill),
        scanlines_(height_ * stride(), 0) {}

  void paint(int x, int y, Rgb /*colour*/, float share) {
    std::uint8_t& covered = scanlines_[static_cast<std::size_t>(y) * stride() + 1 + static_cast<std::size_t>(x)];
    const float sum = static_cast<float>(covered) + 255 * share + 0.5F;
    covered = sum < 255 ? static_cast<std::uint8_t>(sum) : 255;
  }

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  std::size_t stride() const { return 1 + width_; }
  const std::uint8_t* scanline(std::size_t y) const { return &scanlines_[y * stride()]; }

  // 256 colours of three bytes.
  std::string palette() const {
    std::string bytes;
    for (int k = 0; k < 256; ++k)
      for (const auto& [from, to] : {std::pair{grout_.r, fill_.r}, {grout_.g, fill_.g}, {grout_.b, fill_.b}})
        bytes += static_cast<char>((from * (255 - k) + to * k + 127) / 255);
    return bytes;
  }

 private:
  std::size_t width_, height_;
  Rgb grout_, fill_;
  std::vector<std::uint8_t> scanlines_;  // begin with 0, which is no filter
};

}  // namespace tessera

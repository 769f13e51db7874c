// Reads animated PNGs: no library at hand does.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

struct Animation {
  std::uint32_t width = 0, height = 0, promised = 0;  // frames promised by the animation's header
  std::vector<std::string> frames;                    // RGB
  std::vector<unsigned> hundredths;
};

inline std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t length = 4) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < length; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

// Unfiltered RGB lines, as our writer makes them.
inline std::string pixels_of(const std::string& compressed, std::uint32_t width, std::uint32_t height) {
  std::string lines((1 + 3 * std::size_t{width}) * height, '\0'), pixels;
  uLongf size = static_cast<uLongf>(lines.size());
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(lines.data()), &size,
                       reinterpret_cast<const Bytef*>(compressed.data()), static_cast<uLong>(compressed.size())),
            Z_OK);
  EXPECT_EQ(size, lines.size());
  for (std::size_t y = 0; y < height; ++y) {
    EXPECT_EQ(lines[y * (1 + 3 * width)], 0);
    pixels += lines.substr(y * (1 + 3 * width) + 1, 3 * width);
  }
  return pixels;
}

// Checks on the way that chunks are sound, and numbered without a gap.
inline Animation read_animation(std::string_view file) {
  Animation animation;
  std::vector<std::string> compressed;
  std::uint32_t sequence = 0;
  for (std::size_t at = 8; at + 12 <= file.size();) {
    const std::uint32_t size = number_at(file, at);
    const std::string_view type = file.substr(at + 4, 4), data = file.substr(at + 8, size);
    EXPECT_EQ(number_at(file, at + 8 + size),
              crc32(0, reinterpret_cast<const Bytef*>(&file[at + 4]), static_cast<uInt>(size + 4)));
    if (type == "IHDR") animation.width = number_at(data, 0), animation.height = number_at(data, 4);
    if (type == "acTL") animation.promised = number_at(data, 0);
    if (type == "fcTL") {
      EXPECT_EQ(number_at(data, 0), sequence++);
      EXPECT_EQ(number_at(data, 4), animation.width);
      EXPECT_EQ(number_at(data, 8), animation.height);
      EXPECT_EQ(number_at(data, 22, 2), 100u);
      animation.hundredths.push_back(number_at(data, 20, 2));
      compressed.emplace_back();
    }
    if (type == "IDAT") compressed.back() += data;
    if (type == "fdAT") {
      EXPECT_EQ(number_at(data, 0), sequence++);
      compressed.back() += data.substr(4);
    }
    at += 12 + size;
  }
  for (const std::string& frame : compressed)
    animation.frames.push_back(pixels_of(frame, animation.width, animation.height));
  return animation;
}

}  // namespace tessera

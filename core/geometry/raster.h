// A finished picture.
#pragma once

#include <cstdint>
#include <vector>

namespace tessera {

// Rows from the top, no gaps.
struct Raster {
  int width = 0, height = 0;
  int channels = 3;                   // 1: grey, 2: with opacity, 3: RGB, 4: with opacity
  int bits = 8;                       // a channel; 16: the higher byte first
  std::vector<std::uint8_t> bytes{};  // width * height * channels * bits / 8
};

}  // namespace tessera

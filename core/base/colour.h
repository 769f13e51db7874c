#pragma once

#include <array>
#include <cstdint>

namespace tessera {

// sRGB, 8 bits a channel.
struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(Rgb a, Rgb b) { return a.r == b.r && a.g == b.g && a.b == b.b; }
};

// Light of each level of a channel, 0 to 65535. Whole numbers: sums do not depend on their order or on the machine.
const std::array<std::uint32_t, 256>& linear_light();

// A channel of straight opacity 0..255, laid over white.
constexpr std::uint8_t over_white(int value, int opacity) {
  return static_cast<std::uint8_t>((value * opacity + 127) / 255 + 255 - opacity);
}

}  // namespace tessera

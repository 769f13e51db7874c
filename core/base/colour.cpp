#include "tessera/base/colour.h"

#include <cmath>

namespace tessera {

const std::array<std::uint32_t, 256>& linear_light() {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> light{};
    for (int i = 0; i < 256; ++i) {
      const double v = i / 255.0;
      light[i] = static_cast<std::uint32_t>(
          std::lround(65535 * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4))));
    }
    return light;
  }();
  return table;
}

}  // namespace tessera

#include "tessera/pebbles/pebble.h"

#include "tessera/base/portable_math.h"

namespace tessera::pebbles {

Ring outline(const Pebble& pebble) {
  Ring ring;
  ring.reserve(pebble.radii.size());
  for (std::size_t k = 0; k < pebble.radii.size(); ++k) {
    const SinCos turn = sin_cos(2 * kPi * static_cast<double>(k) / static_cast<double>(pebble.radii.size()));
    ring.push_back(pebble.centre + pebble.radii[k] * Point{turn.cos, turn.sin});
  }
  return ring;
}

}  // namespace tessera::pebbles

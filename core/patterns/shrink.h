// Cells that make room for borders.
#pragma once

#include "tessera/geometry/polygon.h"

namespace tessera::patterns {

// A ring, simple and clockwise on the screen, with every side moved inwards by a distance; sides that become too short
// for it vanish on the way, as in a straight skeleton's edge events (Aichholzer et al. 1995). Empty where nothing is
// left. Where a hollow ring would fall apart, by less, as inset() has it.
Ring shrink(const Ring& whole, double distance);

}  // namespace tessera::patterns

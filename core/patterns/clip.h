// Cells as the window sees them.
#pragma once

#include <vector>

#include "tessera/geometry/polygon.h"
#include "tessera/points/window.h"

namespace tessera::patterns {

using Cells = std::vector<Ring>;  // clockwise on the screen, simple

// Appends the parts of a ring, clockwise on the screen, that lie inside the window; a hollow ring may have several.
// Two rings that share a side share it still, to the last bit.
void append_within(const Window& window, Ring ring, Cells& cells);

}  // namespace tessera::patterns

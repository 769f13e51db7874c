// A rasterizer that may fail on the way, backed by one that does not.
#pragma once

#include <functional>
#include <memory>

#include "tessera/voronoi/rasterizer.h"

namespace tessera {

// Draws with `first` until that fails by a fault of its own (kInternal: a lost graphics context, say). From then on
// `second` draws, the labelling that failed included; `on_switch` is told the reason once. Takes both over; neither
// may be null. Its name is that of the one which draws now.
std::unique_ptr<Rasterizer> make_fallback_rasterizer(std::unique_ptr<Rasterizer> first,
                                                     std::unique_ptr<Rasterizer> second,
                                                     std::function<void(const Status& reason)> on_switch);

}  // namespace tessera

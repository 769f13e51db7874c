// Better than first come, first served: pieces exchange their places.
#pragma once

#include <functional>
#include <vector>

#include "tessera/parquetry/assign.h"

namespace tessera::parquetry {

// Exchanges places until nothing is gained or `go_on` is false: a piece moves to where it costs less, what is in its
// way finds other places, and all of them together cost less. Pieces without wood count as the worst there can be.
// Pieces stay valid and their cost never rises. Returns how many exchanges were made.
int exchange_places(Workshop& workshop, std::vector<Laid>& pieces, const std::function<bool()>& go_on);

}  // namespace tessera::parquetry

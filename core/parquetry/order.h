// Which patches choose their wood first (3.3).
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

// Indices of the patches: by saliency, summed over a patch's mask, the largest first; by the distance of its middle
// from the target's, the least first; or row by row. Equal ones in the order given. The targets one after the other,
// or
// (`interleaved`) all together, by the same measure. `targets`: pictures that Patch::target counts.
std::vector<int> order_of(const std::vector<Patch>& patches, const std::vector<cv::Mat3b>& targets, Order order,
                          bool interleaved);

}  // namespace tessera::parquetry

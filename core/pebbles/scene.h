// From pebbles to a scene of meshes.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/scene.h"
#include "tessera/image/image_view.h"
#include "tessera/pebbles/params.h"
#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

// The pebbles as they lie on the photo: x to the right, z down the picture, its middle at the origin, the ground at
// y = 0; or, with `scatter`, strewn over such a field at random. `labels` has the photo's size: 0 the ground, else
// Pebble::id (> 0). A node is named pebble-ID, turns about its pebble's centre of volume, and knows area_px,
// centre_px and radii (px, as many as the finest mesh has meridians). The same scene for any number of threads.
Scene build_scene(const std::vector<Pebble>& pebbles, const cv::Mat1i& labels, const ImageView& photo,
                  const Params& params, std::uint64_t seed);

}  // namespace tessera::pebbles

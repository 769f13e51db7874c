// What was found, drawn over the photo.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/raster.h"
#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

// The photo, 8-bit RGB, with each outline as a bright line in a dark one.
Raster overlay(const cv::Mat3b& photo, const std::vector<Pebble>& pebbles);

}  // namespace tessera::pebbles

// A picture of few colours as what it was before it was drawn: one of m classes for each pixel (section 3).
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/image/image_view.h"

namespace tessera::statistics {

struct Classes {
  std::vector<Rgb> colours;  // of the classes, the most frequent first
  cv::Mat1b labels;          // of each pixel
  bool discrete = false;     // the picture has few colours, and what is between them is where they meet
};

constexpr int kMostClasses = 16;

// `wanted` classes, 2 to kMostClasses, or with 0 as many as there are colours of which a hundredth of the picture is.
// Pixels between two colours, as smooth drawing leaves them at borders, go to a neighbour's class.
Classes find_classes(const ImageView& picture, int wanted);

}  // namespace tessera::statistics

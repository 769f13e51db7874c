// The contract that every backend keeps: CPU, OpenGL ES, WebGL2.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string_view>

#include "tessera/base/status.h"
#include "tessera/voronoi/site.h"

namespace tessera {

// CV_32S, one site index a pixel, kUnlabelled where no site of the pixel's zone is within reach.
using LabelMap = cv::Mat1i;
inline constexpr int kUnlabelled = -1;

class Rasterizer {
 public:
  virtual ~Rasterizer() = default;
  virtual std::string_view name() const = 0;  // "cpu", "gl"

  // Sets the canvas. `zones` (CV_8U, one zone a pixel) is copied or kept by reference count and must not change;
  // `reach` is the distance in px (for kFrustum; in extents for kChebyshev) beyond which a site labels nothing.
  virtual Result<void> begin(const cv::Mat1b& zones, Metric metric, double reach) = 0;

  // Labels every pixel with the nearest site of its zone; equal distances go to the lower index. `labels` is
  // (re)allocated to the canvas' size. Distances beyond `reach` may or may not be labelled alike between backends;
  // within it they are.
  virtual Result<void> label(const Sites& sites, LabelMap& labels) = 0;
};

}  // namespace tessera

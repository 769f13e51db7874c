// A drawing as zones of one colour, and the frontiers between them to a fraction of a pixel.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/image/image_view.h"

namespace tessera {

struct Zones {
  cv::Mat1b map;             // zone of each pixel, an index into `palette`
  std::vector<Rgb> palette;  // colour of each zone's stones
  // Slightly blurred source and, for each zone, its mean in it: where the source passes from one zone's level to
  // another's half way, there is the frontier. One channel (grey) for two zones, three (RGB) for more.
  cv::Mat smooth;
  std::vector<cv::Vec3f> levels;
  double threshold = -1;  // grey level that divides two zones, 0..255; -1 for more zones

  // Signed distance-like measure at (x, y), in pixels of the map: negative in zone a, positive in zone b, zero on
  // their frontier; about -0.5..0.5. Bilinear.
  double frontier(double x, double y, int a, int b) const;
};

// Black and white. `threshold` 0..1 of Rec. 601 grey; 0 finds it: Otsu's, moved half way between the means of the two
// classes it makes (an anti-aliased drawing has a plateau of equally good thresholds; the middle is the edge).
Zones black_and_white(const cv::Mat3b& drawing, double threshold);

// The threshold (0..1) below which the given share (0..1) of the drawing's pixels lies, to a grey level.
double threshold_for_share(const cv::Mat3b& drawing, double share);

// `colors` zones: k-means in Lab from well-spread first centres, without random numbers; pixels that only blend two
// neighbouring zones (anti-aliasing) go to the nearer of the two.
Zones colour_zones(const cv::Mat3b& drawing, int colors);

}  // namespace tessera

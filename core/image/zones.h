// A drawing as zones of one colour, and the frontiers between them to a fraction of a pixel.
#pragma once

#include <array>
#include <cstdint>
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

// `colors` zones: k-means in Lab from well-spread first centres, without random numbers; pixels that only blend two
// neighbouring zones (anti-aliasing) go to the nearer of the two.
Zones colour_zones(const cv::Mat3b& drawing, int colors);

// By what a drawing is divided. It is found by looking at the whole, part after part, so that parts of a drawing too
// large for memory are divided as the whole would be.
struct ZoneRule {
  double threshold = -1;          // as of Zones
  cv::Mat1f centres;              // of more than two zones: their colours in Lab, a row each
  std::vector<Rgb> palette;       // as of Zones
  std::vector<cv::Vec3f> levels;  // as of Zones
  float lightest = 0;             // mean grey of the lighter of two zones
  double sigma = 0;               // px: of the blur that makes Zones::smooth
  int first_white() const;        // the least grey of the lighter of two zones
};

// Pixels of each grey.
using GreyHistogram = std::array<double, 256>;

cv::Mat1b grey_of(const cv::Mat3b& drawing);  // Rec. 601
void add_levels(const cv::Mat1b& grey, GreyHistogram& histogram);
// The threshold (0..1) below which the given share (0..1) of the pixels lies, to a grey level.
double threshold_for_share(const GreyHistogram& histogram, double share);

// Pairs of neighbours in a row that lie on both sides of a frontier, and those of them with a grey between the two
// sides', as an anti-aliased drawing has.
struct Crossings {
  std::int64_t all = 0, blended = 0;
};

// The rule of black_and_white() but for its sigma, which the crossings say.
ZoneRule two_zones(const GreyHistogram& histogram, double threshold);
void add_crossings(const cv::Mat1b& grey, const ZoneRule& rule, Crossings& crossings);
void smooth_as(const Crossings& crossings, ZoneRule& rule);

// The rule of colour_zones(), from samples of rows of the whole from `first_row` on; `samples` begins as 0 x 3.
void add_samples(const cv::Mat3b& part, cv::Size whole, int first_row, cv::Mat1f& samples);
ZoneRule colour_rule(const cv::Mat1f& samples, int colors);

// Zones of a part of the drawing; its margin of 4 px may differ from the whole's.
Zones divide(const cv::Mat3b& part, const ZoneRule& rule);

}  // namespace tessera

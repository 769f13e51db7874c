// What the drawing says at each pixel: its zone, how far the next edge is, how wide the zone is there, and which way
// a stone should turn (paper, III.A).
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/geometry/point.h"
#include "tessera/image/direction_field.h"
#include "tessera/image/distance_field.h"
#include "tessera/image/image_view.h"
#include "tessera/image/zones.h"
#include "tessera/pavement/params.h"

namespace tessera::pavement {

// Angles that vary smoothly over the picture and prefer no direction.
//
// The paper turns each stone by a value of Perlin noise; that value is near zero too often, so stones far from edges
// would favour the axes. Here two noises are the components of a vector, whose direction is uniform; it counts modulo
// a right angle, as a square does. A constant taken off the noise balances what preference its few waves have left.
class NoiseDirection {
 public:
  // Over a picture of this size; all lengths in pixels of the diagram. look_at() all of its rows, then balance().
  NoiseDirection(cv::Size picture, double half_side, double noise_scale, std::uint64_t seed);
  // Takes note of where `rows` are far from edges. `distance` begins at the picture's row `first_row`.
  void look_at(const DistanceField& distance, int first_row, cv::Range rows);
  // Over the places far from edges.
  void balance();
  double angle(double x, double y) const { return field_.angle(x, y); }  // radians

 private:
  cv::Size picture_;
  double half_side_;
  DirectionField field_;
  cv::Mat1b far_;  // one a node
};

// All in pixels of the diagram, which has `scale` pixels a source pixel.
struct Fields {
  double scale = 1;
  double half_side = 4;  // h
  cv::Point origin;      // of a part of a drawing: where in the drawing's diagram it begins
  Zones zones;
  DistanceField distance;

  int zone_at(double x, double y) const;
  Point inside(double x, double y) const;          // the point of the picture nearest to (x, y)
  double distance_near(double x, double y) const;  // of the pixel at or nearest to (x, y)
  void prefetch(double x, double y) const;         // that pixel's distance and zone, for later
  // Half the width of the zone around (x, y): the height of the distance field's ridge uphill from there; at most
  // `cap`.
  double half_width_at(double x, double y, double cap) const;
};

// Half the length of a stone that lies across a band of the given half width, alone.
double half_length(double half_width, double half_side);

Fields make_fields(const ImageView& drawing, const Params& params);
NoiseDirection noise_of(const Fields& fields, const Params& params, std::uint64_t seed);

// The steps of make_fields(), for a drawing that comes in parts.
Fields fields_of(Zones zones, int scale, const Params& params);
// Pixels of these rows that no square of 3 x 3 pixels of their zone covers. They depend on those within 2.
std::int64_t thin_pixels(const cv::Mat1b& zones, cv::Range rows);
int supersample_for(std::int64_t thin, double pixels);
// With `scale` pixels a pixel, smoothed; depends on what is within 4 px.
cv::Mat3b supersampled(const cv::Mat3b& drawing, int scale);

}  // namespace tessera::pavement

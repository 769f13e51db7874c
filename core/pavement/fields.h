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
  // Balanced over the pixels at least `far` from an edge.
  NoiseDirection(const DistanceField& distance, double far, double spacing, double wavelength, std::uint64_t seed);
  double angle(double x, double y) const { return field_.angle(x, y); }  // radians

 private:
  void balance(const DistanceField& distance, double far);

  DirectionField field_;
};

// All in pixels of the diagram, which has `scale` pixels a source pixel.
struct Fields {
  double scale = 1;
  double half_side = 4;  // h
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

}  // namespace tessera::pavement

// An angle to turn by.
#pragma once

#include "tessera/base/portable_math.h"
#include "tessera/geometry/point.h"

namespace tessera {

// Clockwise on the screen; its sine and cosine are the same bits everywhere.
struct Angle {
  double cos = 1, sin = 0;

  static Angle of(double radians) {
    const SinCos both = sin_cos(radians);
    return {both.cos, both.sin};
  }
  static Angle of_degrees(double degrees) { return of(degrees * kPi / 180); }

  Point turned(Point p) const { return {cos * p.x - sin * p.y, sin * p.x + cos * p.y}; }
  Point turned_back(Point p) const { return {cos * p.x + sin * p.y, cos * p.y - sin * p.x}; }
};

}  // namespace tessera

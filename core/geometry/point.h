// Points and small vector algebra, in source pixels unless said otherwise: x right, y down, (0, 0) the picture's top
// left corner, so that the centre of pixel (i, j) is (i + 0.5, j + 0.5).
#pragma once

#include <cmath>

namespace tessera {

struct Point {
  double x = 0;
  double y = 0;

  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
  friend bool operator==(Point a, Point b) { return a.x == b.x && a.y == b.y; }
  Point& operator+=(Point b) { return *this = *this + b; }
  Point& operator-=(Point b) { return *this = *this - b; }
};

inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double length(Point a) { return std::sqrt(dot(a, a)); }

// To multiples of 2^-16, whose sums and differences are exact: what is computed from such points does not tell where
// the origin is.
inline Point snapped(Point p) {
  constexpr double kPerUnit = 65536;
  return {std::floor(kPerUnit * p.x + 0.5) / kPerUnit, std::floor(kPerUnit * p.y + 0.5) / kPerUnit};
}

}  // namespace tessera

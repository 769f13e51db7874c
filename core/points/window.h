// Where points of a process are wanted.
#pragma once

#include "tessera/geometry/point.h"

namespace tessera {

// Points p with low <= p < high. On a periodic one the right side continues at the left, the bottom at the top.
struct Window {
  Point low, high;
  bool periodic = false;

  Point size() const { return high - low; }
  double area() const { return size().x * size().y; }
  bool holds(Point p) const { return low.x <= p.x && p.x < high.x && low.y <= p.y && p.y < high.y; }
  // Larger by so much on every side, and no longer periodic.
  Window grown(double by) const { return {low - Point{by, by}, high + Point{by, by}}; }
  // The same place of a periodic window, within it.
  Point wrapped(Point p) const;
};

inline Point Window::wrapped(Point p) const {
  const auto wrap = [](double v, double from, double to) {
    const double period = to - from, turns = std::floor((v - from) / period);
    const double inside = v - turns * period;
    return inside < to ? inside : from;  // where rounding has reached the end
  };
  return {wrap(p.x, low.x, high.x), wrap(p.y, low.y, high.y)};
}

}  // namespace tessera

// How much of each pixel a polygon covers.
#pragma once

#include <vector>

#include "tessera/geometry/polygon.h"

namespace tessera {

// Exact areas, not samples. A side deposits in each pixel it passes the signed area to its right, and the height it
// climbs for all pixels farther right, so that a running sum along a row is the coverage, that of holes taken away.
class Coverage {
 public:
  // Of a picture of width x height pixels; what lies outside is cut off.
  Coverage(int width, int height) : picture_{0, 0, width, height} {}

  // Calls visit(x, y, covered) for each pixel that the polygon, its coordinates times `scale`, touches; 0 < covered
  // <= 1.
  template <class Visit>
  void each_pixel(const Polygon& polygon, double scale, Visit&& visit) {
    deposit(polygon, scale);
    const float* deposits = cells_.data();
    for (int y = box_.top; y < box_.bottom; ++y, deposits += stride()) {
      float sum = 0;
      for (int x = box_.left; x < box_.right; ++x) {
        sum += deposits[x - box_.left];
        if (sum > kNothing) visit(x, y, sum < 1 - kNothing ? sum : 1.0F);
      }
    }
  }

 private:
  static constexpr float kNothing = 1e-4F;  // rounding errors of the running sum stay below

  struct Box {
    int left = 0, top = 0, right = 0, bottom = 0;
  };

  std::size_t stride() const { return static_cast<std::size_t>(box_.right - box_.left) + 2; }
  void deposit(const Polygon& polygon, double scale);
  void set_ring(const Ring& ring, double scale, const Box& limits);
  void set_box();
  void deposit_ring(float sense);
  void deposit_side(Point a, Point b, float sense);

  Box picture_;
  Box box_;                   // pixels that the polygon at hand may touch
  Ring ring_;                 // the ring at hand, scaled and clipped
  std::vector<float> cells_;  // deposits in box_, two columns wider: sides on its right border deposit there
};

}  // namespace tessera

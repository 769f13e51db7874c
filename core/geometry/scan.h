// The pixels under a polygon.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "tessera/geometry/polygon.h"

namespace tessera {

// Calls visit(y, begin, end) for each row's runs of pixels [begin, end) whose centres lie inside the rings
// (even-odd), of a picture of width x height pixels. Outlines that share a side share no pixel.
template <class Visit>
void each_run(std::span<const Ring* const> rings, int width, int height, Visit&& visit) {
  double top = 1e30, bottom = -1e30;
  for (const Ring* ring : rings)
    for (const Point p : *ring) top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  std::vector<double> crossings;
  const int first = std::max(0, static_cast<int>(std::ceil(std::clamp<double>(top, 0, height) - 0.5)));
  for (int y = first; y < height && y + 0.5 < bottom; ++y) {
    crossings.clear();
    for (const Ring* ring : rings)
      for (std::size_t i = 0; i < ring->size(); ++i) {
        Point a = (*ring)[i], b = (*ring)[i + 1 < ring->size() ? i + 1 : 0];
        if (a.y > b.y) std::swap(a, b);
        if (a.y <= y + 0.5 && y + 0.5 < b.y) crossings.push_back(a.x + (y + 0.5 - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const auto column = [&](double x) {
        return static_cast<int>(std::ceil(std::clamp<double>(x, 0, width) - 0.5));
      };
      const int begin = column(crossings[k]), end = column(crossings[k + 1]);
      if (begin < end) visit(y, begin, end);
    }
  }
}

template <class Visit>
void each_run(const Ring& ring, int width, int height, Visit&& visit) {
  const Ring* rings[] = {&ring};
  each_run(std::span<const Ring* const>(rings), width, height, visit);
}

template <class Visit>
void each_run(const Polygon& polygon, int width, int height, Visit&& visit) {
  std::vector<const Ring*> rings{&polygon.outer};
  for (const Ring& hole : polygon.holes) rings.push_back(&hole);
  each_run(std::span<const Ring* const>(rings), width, height, visit);
}

}  // namespace tessera

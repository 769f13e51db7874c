#include "tessera/pebbles/grains.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera::pebbles {
namespace {

// Second moments of the star-shaped outline about its centre of mass: triangles from the centre, added up.
Grain measured(const Pebble& pebble) {
  const Ring ring = outline(pebble);
  double area = 0, xx = 0, xy = 0, yy = 0;
  Point first{0, 0};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point p = ring[k] - pebble.centre, q = ring[(k + 1) % ring.size()] - pebble.centre;
    const double triangle = cross(p, q) / 2;
    area += triangle;
    first += (triangle / 3) * (p + q);
    xx += triangle / 6 * (p.x * p.x + p.x * q.x + q.x * q.x);
    yy += triangle / 6 * (p.y * p.y + p.y * q.y + q.y * q.y);
    xy += triangle / 12 * (2 * p.x * p.y + p.x * q.y + q.x * p.y + 2 * q.x * q.y);
  }
  const Point mean = (1 / area) * first;
  xx = xx / area - mean.x * mean.x, yy = yy / area - mean.y * mean.y, xy = xy / area - mean.x * mean.y;
  const double half = (xx + yy) / 2, apart = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
  const double longer = std::sqrt(half + apart), shorter = std::sqrt(std::max(1e-12, half - apart));
  // An ellipse of axes a and b has moments a^2 / 16 and b^2 / 16; scaled so that the area is the outline's.
  const double scale = std::sqrt(4 * area / kPi / (longer * shorter));
  double turn = atan2_portable(2 * xy, xx - yy) / 2 * 180 / kPi;
  if (turn < 0) turn += 180;
  return {longer * scale, shorter * scale, turn, area};
}

}  // namespace

std::vector<Grain> measure_grains(const std::vector<Pebble>& pebbles) {
  std::vector<Grain> grains;
  grains.reserve(pebbles.size());
  std::transform(pebbles.begin(), pebbles.end(), std::back_inserter(grains), measured);
  return grains;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double last = static_cast<double>(values.size()) - 1;
  const double place = std::clamp(share * static_cast<double>(values.size()) - 0.5, 0.0, last);
  const auto k = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(k);
  return part > 0 ? (1 - part) * values[k] + part * values[k + 1] : values[k];
}

}  // namespace tessera::pebbles

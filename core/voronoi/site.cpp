#include "tessera/voronoi/site.h"

#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera {

FrustumDistance::FrustumDistance(const Site& site)
    : x_(site.x), y_(site.y), extent_u_(site.extent_u), extent_v_(site.extent_v) {
  const SinCos turn = sin_cos(site.angle);
  cosine_ = turn.cos;
  sine_ = turn.sin;
}

FrustumDistance::Sample FrustumDistance::at(double x, double y) const {
  const double dx = x - x_, dy = y - y_;
  const double u = cosine_ * dx + sine_ * dy, v = cosine_ * dy - sine_ * dx;
  const double a = std::fabs(u) - extent_u_, b = std::fabs(v) - extent_v_;
  const double sign_u = u < 0 ? -1 : 1, sign_v = v < 0 ? -1 : 1;
  double distance, slope_u, slope_v;
  if (a > 0 && b > 0) {
    distance = std::sqrt(a * a + b * b);
    slope_u = sign_u * a / distance;
    slope_v = sign_v * b / distance;
  } else if (a > b) {
    distance = a;
    slope_u = sign_u;
    slope_v = 0;
  } else {
    distance = b;
    slope_u = 0;
    slope_v = sign_v;
  }
  return {distance, cosine_ * slope_u - sine_ * slope_v, sine_ * slope_u + cosine_ * slope_v};
}

}  // namespace tessera

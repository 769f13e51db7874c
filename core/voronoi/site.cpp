#include "tessera/voronoi/site.h"

#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera {

SiteDistance::SiteDistance(const Site& site, Metric metric)
    : metric_(metric), x_(site.x), y_(site.y), extent_u_(site.extent_u), extent_v_(site.extent_v) {
  const SinCos turn = sin_cos(site.angle);
  cosine_ = turn.cos;
  sine_ = turn.sin;
}

SiteDistance::Sample SiteDistance::turned(double distance, double slope_u, double slope_v) const {
  return {distance, cosine_ * slope_u - sine_ * slope_v, sine_ * slope_u + cosine_ * slope_v};
}

SiteDistance::Sample SiteDistance::at(double x, double y) const {
  const double dx = x - x_, dy = y - y_;
  const double u = cosine_ * dx + sine_ * dy, v = cosine_ * dy - sine_ * dx;
  const double sign_u = u < 0 ? -1 : 1, sign_v = v < 0 ? -1 : 1;
  if (metric_ == Metric::kChebyshev) {
    const double a = std::fabs(u) / extent_u_, b = std::fabs(v) / extent_v_;
    return a > b ? turned(a, sign_u / extent_u_, 0) : turned(b, 0, sign_v / extent_v_);
  }
  const double a = std::fabs(u) - extent_u_, b = std::fabs(v) - extent_v_;
  if (a > 0 && b > 0) {
    const double distance = std::sqrt(a * a + b * b);
    return turned(distance, sign_u * a / distance, sign_v * b / distance);
  }
  return a > b ? turned(a, sign_u, 0) : turned(b, 0, sign_v);
}

}  // namespace tessera

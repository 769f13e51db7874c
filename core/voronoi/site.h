// The generating points of a Voronoi diagram, and how distance to one is measured.
#pragma once

#include <cstdint>
#include <vector>

namespace tessera {

// Distance from a pixel's centre to a site, in the site's own frame: (u, v) = the offset turned by -angle.
//   kFrustum    distance to a rectangle of half sides (extent_u, extent_v), round at its corners; inside it minus the
//               distance to its border, so that neighbouring rectangles may overlap. Extents 0: Euclid.
//   kChebyshev  max(|u| / extent_u, |v| / extent_v): squares and rectangles (Manhattan is the same turned by 45
//   degrees).
enum class Metric { kFrustum, kChebyshev };

// Position in pixels of the label map; pixel (i, j) has its centre at (i + 0.5, j + 0.5). Positions are multiples of
// 2^-10 px and angles of 2^-16 turn, so that small differences between platforms cannot grow over iterations.
struct Site {
  double x = 0, y = 0;
  double angle = 0;                  // radians, from x towards y
  float extent_u = 0, extent_v = 0;  // px for kFrustum, a factor for kChebyshev
  std::uint8_t zone = 0;             // only pixels of this zone may belong to the site
};

using Sites = std::vector<Site>;

// A site's frame, ready for measuring distances to it in double precision.
class SiteDistance {
 public:
  SiteDistance(const Site& site, Metric metric);

  struct Sample {
    double distance;
    double slope_x, slope_y;  // its gradient; (0, 0) where it has none
  };
  Sample at(double x, double y) const;

 private:
  Sample turned(double distance, double slope_u, double slope_v) const;

  Metric metric_;
  double x_, y_, cosine_, sine_, extent_u_, extent_v_;
};

}  // namespace tessera

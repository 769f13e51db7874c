#include "tessera/formats/measures.h"

#include <cmath>

namespace tessera {

Measures measure(const Polygon& outline) {
  Measures m;
  m.area = area(outline);
  m.perimeter = perimeter(outline.outer);
  m.vertices = outline.outer.size();
  m.centroid = centroid(outline.outer);
  const double degrees = orientation_deg(outline.outer);
  m.orientation = degrees < 179.9995 ? degrees : 0;
  for (const Ring& hole : outline.holes) {
    m.perimeter += perimeter(hole);
    m.vertices += hole.size();
    if (m.area > 0) m.centroid += std::abs(signed_area(hole)) / m.area * (centroid(outline.outer) - centroid(hole));
  }
  return m;
}

}  // namespace tessera

#include "tessera/parquetry/patch.h"

#include "tessera/geometry/angle.h"

namespace tessera::parquetry {
namespace {

Ring on_panel(const Placement& placement, Angle angle, const Ring& ring) {
  Ring turned;
  turned.reserve(ring.size());
  for (const Point vertex : ring) turned.push_back(placement.to + angle.turned_back(vertex - placement.from));
  return turned;
}

}  // namespace

Polygon on_panel(const Placement& placement, const Polygon& outline) {
  const Angle angle = Angle::of_degrees(placement.turn_deg);
  Polygon cut{on_panel(placement, angle, outline.outer), {}};
  for (const Ring& hole : outline.holes) cut.holes.push_back(on_panel(placement, angle, hole));
  return cut;
}

}  // namespace tessera::parquetry

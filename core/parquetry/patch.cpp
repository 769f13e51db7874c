#include "tessera/parquetry/patch.h"

#include "tessera/base/portable_math.h"

namespace tessera::parquetry {
namespace {

Ring on_panel(const Placement& placement, SinCos turn, const Ring& ring) {
  Ring turned;
  turned.reserve(ring.size());
  for (const Point vertex : ring) {
    const Point offset = vertex - placement.from;
    turned.push_back(placement.to +
                     Point{turn.cos * offset.x + turn.sin * offset.y, turn.cos * offset.y - turn.sin * offset.x});
  }
  return turned;
}

}  // namespace

Polygon on_panel(const Placement& placement, const Polygon& outline) {
  const SinCos turn = sin_cos(placement.turn_deg * kPi / 180);
  Polygon cut{on_panel(placement, turn, outline.outer), {}};
  for (const Ring& hole : outline.holes) cut.holes.push_back(on_panel(placement, turn, hole));
  return cut;
}

}  // namespace tessera::parquetry

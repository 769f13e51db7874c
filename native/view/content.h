// What a window can show.
#pragma once

#include <functional>
#include <memory>
#include <variant>

#include "tessera/geometry/piece.h"
#include "tessera/geometry/raster.h"
#include "tessera/geometry/scene.h"
#include "tessera/view/flat_camera.h"

namespace tessera::view {

// A picture, or pieces, which are drawn as large as they are shown.
struct Flat {
  std::variant<Raster, PieceSheet> made;
  Size size;  // in source pixels, which the camera counts in
};

// One of the two at least. The solid is made when it is asked for, in the window's thread; it has a view.
struct Content {
  std::shared_ptr<const Flat> flat;
  std::function<std::shared_ptr<const Scene>()> solid;
  bool solid_first = false;  // where there are both
};

}  // namespace tessera::view

// Labels rows of tiles: draws sites first, then searches for pixels that are far from all of them. Compiled once for
// each vector instruction set (Highway's foreach_target). No fused multiply-add anywhere: every instruction set gives
// the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tessera/voronoi/cpu_kernel.cpp"
// clang-format off
#include <hwy/foreach_target.h>
// clang-format on

#include "tessera/voronoi/cpu_kernel.h"

#include "tessera/voronoi/draw_sites-inl.h"
#include "tessera/voronoi/search_sites-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

template <Metric metric>
void label_rows(const KernelArguments& arguments, int begin, int end) {
  Drawing<metric> drawing(arguments);
  Search<metric> search(arguments);
  for (int y = begin * kTileHeight; y < end * kTileHeight; y += kTileHeight) {
    for (int x = 0; x < arguments.width; x += kTileWidth) {
      drawing.draw(x, y);
      for (int j = 0; j < kTileHeight; j += kSearchHeight)
        for (int i = 0; i < kTileWidth; i += kSearchWidth)
          if (drawing.has_unlabelled(i, j, kSearchWidth, kSearchHeight)) search.complete(x + i, y + j);
    }
  }
}

void label_tile_rows(const KernelArguments& arguments, int begin, int end) {
  if (arguments.metric == Metric::kFrustum) {
    label_rows<Metric::kFrustum>(arguments, begin, end);
  } else {
    label_rows<Metric::kChebyshev>(arguments, begin, end);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {
HWY_EXPORT(label_tile_rows);
void label_tile_rows(const KernelArguments& arguments, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(label_tile_rows)(arguments, begin, end);
}
}  // namespace tessera
#endif

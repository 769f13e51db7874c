// The reference backend: exact, tiled, vectorised, on all threads of cv::parallel_for_.
#pragma once

#include <memory>

#include "tessera/voronoi/rasterizer.h"

namespace tessera {

std::unique_ptr<Rasterizer> make_cpu_rasterizer();

}  // namespace tessera

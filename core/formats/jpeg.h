// JPEG pictures, for textures.
#pragma once

#include <string>

#include "tessera/geometry/scene.h"

namespace tessera {

// Baseline JPEG, colours at full resolution where quality (1..100) is above 90. The texture has pixels, at most
// 65,535 each way.
std::string write_jpeg(const Texture& texture, int quality);

}  // namespace tessera

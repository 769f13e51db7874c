// How well tiles keep to directions and edges.
#pragma once

#include "tessera/mosaic/fields.h"
#include "tessera/mosaic/run.h"

namespace tessera::mosaic {

// Fills in the angles and counts of `output` from its sheet.
void measure_tiles(const Fields& fields, Output& output);

}  // namespace tessera::mosaic

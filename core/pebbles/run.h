// Pebbles: one top-down photo in, a field of stones out.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/geometry/piece.h"
#include "tessera/geometry/scene.h"
#include "tessera/image/image_view.h"
#include "tessera/pebbles/grains.h"
#include "tessera/pebbles/params.h"
#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

struct Pictures {
  ImageView photo;
  ImageView segmentation;  // labels made elsewhere, for Segmenter::kLabels; no pixels: none
};

struct Output {
  cv::Mat1i labels;             // of each pixel of the photo: 0 is ground, else a pebble's id
  std::vector<Pebble> pebbles;  // in source pixels; ids from 1, in reading order
  std::vector<Grain> grains;    // one a pebble, in their order
  double metres_per_px = 0;
  Scene scene;       // the stones
  PieceSheet sheet;  // the outlines, in source pixels
};

// The pictures are read during the call only; all parameters are valid. A photo without pebbles makes an empty field
// and a warning. Fails with kInvalidInput for a photo without pixels or labels of another size, kCancelled or
// kTimeout as `context` says. Same arguments, same result, for any number of threads.
Result<Output> run(const Pictures& pictures, const Params& params, std::uint64_t seed, const RunContext& context);

}  // namespace tessera::pebbles

// Pictures of a diagram's iterations, for an animation.
#pragma once

#include <vector>

#include "tessera/formats/formats.h"
#include "tessera/image/image_view.h"
#include "tessera/voronoi/lloyd.h"

namespace tessera {

// Draws each cell in the mean colour of the picture under it, darker where it meets another. Of many iterations every
// n-th and the last one, the fewest n that keep to 60 frames.
class Recorder {
 public:
  // The frames have the source's proportions, and 800 px on the longer side at most. `source` is read on.
  explicit Recorder(const ImageView& source);

  void record(const Iteration& iteration);
  std::vector<Raster> take() { return std::move(frames_); }

 private:
  ImageView source_;
  int width_, height_;
  std::vector<Raster> frames_;
};

}  // namespace tessera

// Pictures of a diagram's iterations, for an animation.
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/geometry/raster.h"
#include "tessera/image/image_view.h"
#include "tessera/voronoi/lloyd.h"

namespace tessera {

// Draws each cell in the mean colour of the picture under it, darker where it meets another. Of many iterations every
// n-th and the last one, the fewest n that keep to 60 frames and to 54 MB. Recording copies labels and no more, so
// that a run loses next to no time on frames that nobody may ask for.
class Recorder {
 public:
  // The frames have the source's proportions, and 800 px on the longer side at most. `source` is read here only.
  explicit Recorder(const ImageView& source);

  void record(const Iteration& iteration);
  int frames() const { return static_cast<int>(recorded_.size()); }
  Raster frame(int index) const;

  // One iteration as a frame.
  static Raster draw(const ImageView& source, const Iteration& iteration);

 private:
  void keep(const Iteration& iteration);

  struct Recorded {
    LabelMap labels;  // at the frame's pixels
    std::size_t sites;
  };
  cv::Mat3b source_;  // as large as a frame
  std::vector<Recorded> recorded_;
};

}  // namespace tessera

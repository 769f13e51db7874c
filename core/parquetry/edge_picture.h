// The edges of the target that a morphed grid follows (3.4, a-priori refinement).
#pragma once

#include <opencv2/core.hpp>

#include "tessera/base/status.h"
#include "tessera/geometry/point.h"
#include "tessera/image/distance_field.h"
#include "tessera/image/image_view.h"
#include "tessera/parquetry/patches.h"

namespace tessera::parquetry {

// Where edges of either kind count, Eq. 5: not 0. Of any size, stretched over the target; empty: everywhere.
struct EdgeMasks {
  cv::Mat1b rolling_guidance, bilateral;
};
// Of one picture for both kinds: large edges count where it is red, fine ones where it is blue (128 of 255 and more);
// both where it is white, none where it is black. kInvalidInput for `edge-mask` where its proportions are not the
// target's, within a hundredth. Without pixels: empty.
Result<EdgeMasks> edge_masks_of(const ImageView& picture, cv::Size target);

// What the two detectors of Eq. 5 find, of one size: 255 on an edge, else 0.
struct FoundEdges {
  cv::Mat1b rolling_guidance, bilateral;
};
FoundEdges edges_of(const cv::Mat3b& target, const Grid& grid);
FoundEdges masked(const FoundEdges& found, const EdgeMasks& masks);  // those that count, Eq. 5

// Edges at a resolution of some twenty pixels a patch, so that the same grid comes of a picture at any resolution.
// All points and lengths are in pixels of the target.
class EdgePicture {
 public:
  // `reach`: how far edges attract, > 0.
  EdgePicture(const cv::Mat3b& target, const Grid& grid, double reach, const EdgeMasks& masks = {});
  // The same of those that count on a target of that size.
  EdgePicture(const FoundEdges& counting, cv::Size target, double reach);

  const cv::Mat1b& edges() const { return edges_; }  // E: 255 on an edge, else 0
  const cv::Mat1f& potential() const { return potential_; }
  double px() const { return px_.x; }  // side of a pixel of `edges`

  double distance(Point p) const;  // from the next edge; very large where there is none
  Point downhill(Point p) const;   // -grad P, whose length is 1 in the attraction's reach

 private:
  Point px_;  // width and height of a pixel: all but equal
  cv::Mat1b edges_;
  DistanceField distance_;
  cv::Mat1f potential_;
};

}  // namespace tessera::parquetry

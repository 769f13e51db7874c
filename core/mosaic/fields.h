// What the photo says at each place: where edges are, which way a tile turns, how large it is (paper, 4 and 5.2).
#pragma once

#include <opencv2/core.hpp>

#include "tessera/geometry/point.h"
#include "tessera/image/direction_field.h"
#include "tessera/image/distance_field.h"
#include "tessera/image/image_view.h"
#include "tessera/mosaic/params.h"
#include "tessera/mosaic/torus.h"
#include "tessera/voronoi/rasterizer.h"

namespace tessera::mosaic {

// The pictures that a mosaic may be made of. All but the photo are optional, and of any size: they are fitted to it.
struct Pictures {
  ImageView photo;
  ImageView edges;      // dark or light lines on the other: used instead of those found
  ImageView direction;  // grey 0..255 is an angle of 0..180 degrees, from x towards y
  ImageView regions;    // colours that params.region_sizes names
};

struct Fields {
  Torus torus;               // the photo is its window
  cv::Size size;             // of the canvas: the photo, or with a margin around it
  cv::Mat1b edges;           // 255 on an edge
  DistanceField distance;    // px to the next edge pixel; kNoFrontier where there is none
  DistanceField to_line;     // px to the next pixel of an edge or of a finer line, to which tiles' corners move
  DirectionField direction;  // of the tiles' u axis, across edges
  cv::Mat1f sides;           // of a square tile, px, at nodes `step` apart, the first at (0, 0)
  double step = 1;

  // The nodes whose sides count for the photo.
  cv::Mat1f sides_within() const;
  double side(double x, double y) const;  // of a square tile at (x, y)
  Point inside(Point p) const;            // the point of the picture nearest to p
  Point uphill(Point p) const;            // unit vector away from the next edge; (0, 0) where there is none
  Point uphill_of(const DistanceField& field, Point p) const;  // the same of another of the fields
};

// `side`: what a tile measures on average, px. All problems of the other pictures end in sensible fields: an edge
// picture without lines means no edges. For seamless mosaics all pictures are repeated in a margin.
//
// The distance to the edges is the height of mountains, read off the depth buffer of `rasterizer` where it draws into
// one (4), and else by its exact twin, the distance transform.
Fields make_fields(const Pictures& pictures, const Params& params, double side, Rasterizer* rasterizer = nullptr);

// The sides scaled for all tiles by a factor.
void scale_sides(Fields& fields, double factor);

}  // namespace tessera::mosaic

// The distance to edges as the height of mountains: "Simulating Decorative Mosaics" (Hausner 2001), section 4, after
// Hoff et al., "Fast Computation of Generalized Voronoi Diagrams Using Graphics Hardware" (1999).
#pragma once

#include "tessera/image/distance_field.h"
#include "tessera/voronoi/rasterizer.h"

namespace tessera {

// What edge_distance() gives, px, drawn by the rasterizer, whose canvas it takes: the `gl` backend draws a cone for
// each edge pixel into its depth buffer, and together they are the mountain whose ridge is the edge. kNoFrontier
// where there is no edge. Fails as the rasterizer does.
//
// Cones are drawn to a reach of 8 px, then to 16 and so on: only a pixel that is still the nearest one at the rim of
// a reach can be so beyond it, since cells of points are convex. Cells that are thinner than a pixel at a rim are
// lost there, hence the tolerance: never nearer than edge_distance(), farther by at most 0.1 px and by what the
// rasterizer may be wrong (gl: 0.5 %), on average by less than 0.02 px. Gradients over two pixels differ by less than
// half a degree on average, crests aside.
Result<DistanceField> ridge_distance(const cv::Mat1b& edges, Rasterizer& rasterizer);

}  // namespace tessera

// Cells of given points: Voronoi polygons and Delaunay triangles (3.2 b).
#pragma once

#include <vector>

#include "tessera/patterns/clip.h"

namespace tessera::patterns {

// The points are those of a window grown far enough that none farther away matters; those of a periodic window are
// the window's own. Cells that the window cuts are cut at it; in a periodic one they stick out. Vertices are exact to
// 1e-8 of the window. Equal points count once. Points farther than `reach` > 0 from a place are known not to matter
// there (Delaunay: than twice of it), so that many points can be taken in parts; 0: nothing is known. O(n log n).
Cells voronoi_cells(const std::vector<Point>& points, const Window& window, double reach = 0);
Cells delaunay_cells(const std::vector<Point>& points, const Window& window, double reach = 0);

// How far beyond the window points of a process matter to its Voronoi cells, if it has at least that intensity
// everywhere: farther away with a chance of less than 1e-15 a cell.
double voronoi_reach(double intensity);

}  // namespace tessera::patterns

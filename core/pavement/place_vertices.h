// From the diagram's pixels to a tessellation with sub-pixel vertices (paper, III.C, first half).
#pragma once

#include "tessera/pavement/diagram.h"
#include "tessera/pavement/fields.h"
#include "tessera/tessellation/tessellation.h"

namespace tessera::pavement {

// The paper puts vertices at pixel corners, which makes every stone favour the axes, and sorts them by angle, which
// takes cells to be star-shaped. Here a vertex among stones of one zone solves for equal distance from its sites, one
// on a frontier lies on the half-way contour of the source, and outlines are traced. Corners of the drawing become
// vertices; cells with fewer than four vertices are given more.
Tessellation place_vertices(const Diagram& diagram, const Fields& fields);

// Moves p along the gradient onto the frontier between zones a and b. Returns false, p unchanged, where there is none
// within `limit` pixels.
bool to_frontier(const Zones& zones, int a, int b, double limit, Point& p);

// Where a vertex that was moved to `p` belongs: on its frontier, if it has one, and within the picture.
Point back_to_frontier(const Tessellation& t, const Fields& fields, int vertex, Point p);

}  // namespace tessera::pavement

// From the diagram's pixels to cells that share sub-pixel vertices.
#pragma once

#include "tessera/mosaic/diagram.h"
#include "tessera/tessellation/tessellation.h"

namespace tessera::mosaic {

// A vertex lies where its cells' sites are equally far; one near an edge lies on the edge, so that tiles' sides
// follow it. Cells with fewer than four vertices are given more. On a torus the cells of its window are left, those
// of the diagram's own sites first.
Tessellation place_vertices(const Diagram& diagram, const Fields& fields);

// Where a vertex that was moved to `p` belongs: on its edge, if it has one, and within the picture.
Point back_to_edge(const Tessellation& t, const Fields& fields, int vertex, Point p);

// The outline of each cell as it is, corners and bends, for tiles that are the cells themselves.
std::vector<Ring> whole_cells(const Tessellation& t);

}  // namespace tessera::mosaic

// Outlines of cells from their boundary graph.
#pragma once

#include <functional>
#include <vector>

#include "tessera/tessellation/tessellation.h"
#include "tessera/voronoi/trace.h"

namespace tessera {

// Vertices along each arc, between its junctions; in the arc's direction.
using Bends = std::vector<std::vector<Point>>;
// An arc's course from its first junction to its second, both included.
using Course = std::function<std::vector<Point>(int arc)>;

// A piece has four corners at least: the longest arcs of cells with fewer get the missing ones.
void complete_rings(const CellGraph& graph, const CellRings& rings, const Course& course, Bends& bends);

// Appends the bends to `t`, whose vertices are the graph's junctions so far, and makes its map's rings. Bends on the
// picture's border and between zones are fixed.
void assemble_rings(const CellGraph& graph, const CellRings& rings, const Bends& bends, Tessellation& t);

}  // namespace tessera

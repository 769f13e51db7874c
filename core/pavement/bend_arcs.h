// Arcs that a straight line does not do justice to, and the outlines made of them.
#pragma once

#include "tessera/pavement/place_vertices.h"

namespace tessera::pavement {

// `t` comes with the diagram's junctions as vertices; leaves with the vertices that bends need, and with its rings.
//
// Where an arc on a frontier turns a corner of the drawing, a joint of the stones on the hollow side moves into the
// corner if there is one near (no stone has to be L-shaped then); else the corner becomes a vertex of two stones.
void bend_arcs(const Diagram& diagram, const Fields& fields, Tessellation& t);

}  // namespace tessera::pavement

// Each piece alone: its own outline, and grout around it (pavement paper, III.C, second half).
#pragma once

#include <vector>

#include "tessera/geometry/polygon.h"
#include "tessera/tessellation/tessellation.h"

namespace tessera {

// One ring a cell, in pixels of the diagram. Vertices where a piece is flat are left out, corners wider than
// `wide_angle` (degrees) and tiny sides too as long as four corners remain. Rings may be empty where nothing of a
// cell is left.
std::vector<Ring> separate_pieces(const Tessellation& t, const std::vector<char>& flat, double wide_angle);

// The ring with coordinates rounded to multiples of 1 / `parts`, and still an outline: vertices that this lays upon
// another side are left out, a ring of four or more keeps four. Empty where nothing is left.
Ring rounded_outline(const Ring& ring, double parts);

// Moves each vertex towards the centre of mass by half of the grout, less for pieces smaller than others. Lengths in
// source pixels.
void shrink(Ring& ring, double grout, double half_side);

}  // namespace tessera

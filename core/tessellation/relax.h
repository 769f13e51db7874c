// Straightening: vertices move until every flat angle is flat.
#pragma once

#include <functional>
#include <opencv2/core/types.hpp>
#include <vector>

#include "tessera/tessellation/tessellation.h"

namespace tessera {

// Where a vertex belongs that has moved to `p`: on the frontier it is bound to, within the picture. Called from
// several threads.
using Back = std::function<Point(int vertex, Point p)>;

// Projects the constraints one after the other, in rounds: a flat slot's vertex onto the line between its neighbours,
// which give way a little; other corners out of hollows. Frontier and border vertices slide only along theirs.
// A round takes what moves in a block of 24 h no farther than into the blocks around it, and begins from places that
// do not tell where the origin is: far from its border, a part of a picture comes out as in the whole
// (pavement/tiles.h).
struct RelaxParams {
  int rounds = 30;
  double pull = 0.2;  // how strongly vertices are drawn back to where they began, in the first half of the rounds
  double squareness = 0.3;  // how far corners go, in a round, to the rectangle in the piece's frame, if it has one
  // How far a flat vertex may be off its piece's side in the end, in h, to count as flat: away from the piece, which
  // leaves a gap, and into it, which makes its neighbours overlap it.
  double gap = 0.15, overlap = 0.15;
  cv::Point origin{};          // of a part of a picture: where in the picture it begins
  bool frontiers_too = false;  // whether that holds for vertices on frontiers, not among pieces of one zone alone
};

// A vertex whose place is known already: it goes there after the rounds, and does not leave it.
struct Pin {
  int vertex;
  Point place;
};

// A piece that came out of it tangled goes back to where it began, and its vertices are flat no more (`flat` is
// changed).
void relax(Tessellation& t, std::vector<char>& flat, const Back& back, const RelaxParams& params = {},
           const std::vector<Pin>& pins = {});

}  // namespace tessera

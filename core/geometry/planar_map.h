// A tessellation whose cells share their vertices.
#pragma once

#include <vector>

#include "tessera/geometry/point.h"

namespace tessera {

// Cell c's outline runs clockwise on the screen through vertices[ring[k]] for the slots k in [first[c], first[c +
// 1]). Moving a vertex moves it for all its cells, so neighbours never part nor overlap. On a torus a cell may see a
// vertex some periods away from where another does.
struct PlanarMap {
  std::vector<Point> vertices;
  std::vector<int> first{0};
  std::vector<int> ring;
  std::vector<Point> shift;  // of a slot against its vertex; empty: none is shifted

  int cells() const { return static_cast<int>(first.size()) - 1; }
  int corners(int cell) const { return first[cell + 1] - first[cell]; }
  int next(int cell, int slot) const { return slot + 1 < first[cell + 1] ? slot + 1 : first[cell]; }
  int previous(int cell, int slot) const { return slot > first[cell] ? slot - 1 : first[cell + 1] - 1; }
  std::vector<Point> outline(int cell) const {
    std::vector<Point> outline;
    for (int slot = first[cell]; slot < first[cell + 1]; ++slot) outline.push_back(at(slot));
    return outline;
  }
  Point at(int slot) const { return shift.empty() ? vertices[ring[slot]] : vertices[ring[slot]] + shift[slot]; }
};

}  // namespace tessera

// A grid whose vertices snap to the edges of the picture (3.4, a-priori refinement), step by step, so that a page can
// show it while somebody drags a vertex.
#pragma once

#include <vector>

#include "tessera/parquetry/edge_picture.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/pins.h"

namespace tessera::parquetry {

// A mass-spring-damper system, Eq. 7, solved by explicit Euler. Vertices on a border slide along it, those in the
// corners stay. A vertex goes no step that would fold a cell, make one of its corners sharper than 55 degrees or
// blunter than 150, or leave it less room than for a disc of `least_width`, or an end that is too narrow for one.
class MorphingGrid {
 public:
  // All in pixels of the target. `edges` outlive this. `weight`: w of Eq. 7, for cells of side 1 and m = 1.
  MorphingGrid(const Grid& grid, const EdgePicture& edges, double weight, double least_width);

  int across() const { return across_; }  // cells
  int down() const { return down_; }
  Point vertex(int column, int row) const { return vertices_[index(column, row)]; }

  // From now on the vertex goes to `pin.at` and stays there; one on a border, only along it. It must be of the grid.
  void pin(const Pin& pin);
  void unpin(int column, int row);
  std::vector<Pin> pins() const;  // row by row
  bool is_in_place(const Pin& pin) const;

  // A step of time.
  void step();
  // Nothing moves any more, or there have been as many steps as there may be since a vertex was pinned or unpinned.
  bool is_at_rest() const { return at_rest_; }
  // Steps until it is at rest.
  void settle();

 private:
  struct Hold {
    bool pinned = false;
    Point at;
  };
  int index(int column, int row) const { return row * (across_ + 1) + column; }
  Point allowed(int column, int row, Point way) const;  // of a way what the borders leave
  Point force(int column, int row) const;
  bool is_sound(int column, int row) const;          // a cell
  bool are_sound_around(int column, int row) const;  // the cells of a vertex
  double move(int column, int row, Point way);
  void wake();

  int across_, down_;
  const EdgePicture& edges_;
  double side_, weight_, least_radius_;
  std::vector<Point> vertices_, velocities_;  // row by row
  std::vector<Hold> holds_;
  int steps_ = 0;  // since a vertex was pinned or unpinned
  bool at_rest_ = false;
};

}  // namespace tessera::parquetry

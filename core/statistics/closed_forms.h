// What the mathematics of the models says: the curves that measured ones are held against.
#pragma once

#include <string_view>
#include <vector>

namespace tessera::statistics {

// Cell models by the one number each has: poisson-lines, lines' intensity in (theta, p); occupancy and delaunay,
// points an area; johnson-mehl, rate / speed; checkerboard, hexagon, triangle, the side.
enum class CellModel { kPoissonLines, kOccupancy, kDelaunay, kJohnsonMehl, kCheckerboard, kHexagon, kTriangle };

struct NamedModel {
  CellModel model;
  std::string_view name;
};
const std::vector<NamedModel>& cell_models();

// W(d), the chance that two points at distance d >= 0 lie in one cell; below 0 where there is no closed form
// (delaunay, johnson-mehl).
double same_cell_chance(CellModel model, double x, double d);

// Discs of radius r dropped at random, which cover the share `covered` of the plane: the chance that two points at
// distance 2 r x are both covered (section 4 c).
double both_covered(double covered, double x);

// Means of the typical cell.
struct TypicalCell {
  double per_area, area, perimeter, sides;  // 0: not known
  double area_variance;                     // below 0: not known
};
TypicalCell typical_cell(CellModel model, double x);

}  // namespace tessera::statistics

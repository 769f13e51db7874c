#include "tessera/statistics/closed_forms.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera::statistics {
namespace {

// Part of the plane that a cell covers of its copy moved by d, meaned over all directions, for a regular polygon of
// side 1. The intersection of a convex polygon with its copy has the area of those vertices that are in both, and of
// crossings; a sum over thin strips across the way does without.
double turned_overlap(int sides, double d) {
  constexpr int kAngles = 180, kStrips = 400;
  const double circumradius = 0.5 / sin_cos(kPi / sides).sin;
  const double area = sides * circumradius * circumradius * sin_cos(2 * kPi / sides).sin / 2;
  double sum = 0;
  for (int a = 0; a < kAngles; ++a) {
    // The way runs along x; chords of the polygon along it overlap by their length less d.
    const double turn = 2 * kPi / sides * (a + 0.5) / kAngles;
    double overlap = 0;
    for (int s = 0; s < kStrips; ++s) {
      const double y = circumradius * (2 * (s + 0.5) / kStrips - 1);
      double left = -1e300, right = 1e300;
      for (int k = 0; k < sides; ++k) {
        // Inside is where the normal's coordinate is below the apothem.
        const SinCos normal = sin_cos(turn + 2 * kPi * k / sides);
        const double apothem = circumradius * sin_cos(kPi / sides).cos, rest = apothem - normal.sin * y;
        if (normal.cos > 1e-12)
          right = std::min(right, rest / normal.cos);
        else if (normal.cos < -1e-12)
          left = std::max(left, rest / normal.cos);
        else if (rest < 0)
          right = -1e300;
      }
      overlap += std::max(0.0, right - left - d) * 2 * circumradius / kStrips;
    }
    sum += overlap / area / kAngles;
  }
  return sum;
}

double checkerboard(double u) {
  if (u <= 1) return 1 - 4 * u / kPi + u * u / kPi;
  if (u >= std::sqrt(2.0)) return 0;
  return 1 - 2 / kPi - 4 / kPi * std::acos(1 / u) - u * u / kPi + 4 / kPi * std::sqrt(u * u - 1);
}

double hexagon(double u) {
  const double root = std::sqrt(3.0);
  if (u >= 2) return 0;
  return u <= 1 ? 1 - 4 * u / (root * kPi) + (root / (3 * kPi) - 1.0 / 9) * u * u : turned_overlap(6, u);
}

double triangle(double u) {
  const double root = std::sqrt(3.0), k = 2 * u / root;
  if (u >= 1) return 0;
  const double more = k > 1 ? 6 / kPi * (1.5 * std::sqrt(k * k - 1) - (1 + k * k / 2) * std::acos(1 / k)) : 0;
  return 1 - 6 * k / kPi + k * k * (0.5 + 3 * root / (4 * kPi)) + more;
}

// Both points are nearest to one nucleus: the integral, over its place, of the chance that no other lies in the union
// of the two discs about the points that pass through it. Points at (0, 0) and (d, 0), intensity 1.
double occupancy(double d) {
  constexpr int kRadii = 160, kAngles = 96;
  constexpr double kReach = 4;
  double sum = 0;
  for (int i = 0; i < kRadii; ++i) {
    const double r = kReach * (i + 0.5) / kRadii;
    for (int k = 0; k < kAngles; ++k) {
      const double turn = kPi * (k + 0.5) / kAngles;
      const double s = std::sqrt(std::max(0.0, r * r + d * d - 2 * r * d * sin_cos(turn).cos));
      // The lens of discs of radii r and s at distance d, by the angles at which they see their common chord.
      double lens = kPi * std::min(r, s) * std::min(r, s);
      if (d > 1e-9 && s > 1e-9 && d > std::abs(r - s)) {
        const double at_r = std::acos(std::clamp((d * d + r * r - s * s) / (2 * d * r), -1.0, 1.0));
        const double at_s = std::acos(std::clamp((d * d + s * s - r * r) / (2 * d * s), -1.0, 1.0));
        lens = r * r * (at_r - std::sin(2 * at_r) / 2) + s * s * (at_s - std::sin(2 * at_s) / 2);
      }
      const double both = kPi * (r * r + s * s) - lens;
      sum += 2 * r * std::exp(-both) * (kPi / kAngles) * (kReach / kRadii);
    }
  }
  return sum;
}

TypicalCell regular(int sides, double side) {
  const double area = sides * side * side / (4 * std::tan(kPi / sides));
  return {1 / area, area, sides * side, static_cast<double>(sides), 0};
}

}  // namespace

const std::vector<NamedModel>& cell_models() {
  static const std::vector<NamedModel> all = {
      {CellModel::kPoissonLines, "poisson-lines"}, {CellModel::kOccupancy, "occupancy"},
      {CellModel::kDelaunay, "delaunay"},          {CellModel::kJohnsonMehl, "johnson-mehl"},
      {CellModel::kCheckerboard, "checkerboard"},  {CellModel::kHexagon, "hexagon"},
      {CellModel::kTriangle, "triangle"}};
  return all;
}

double both_covered(double covered, double x) {
  const double union_of_two = x < 1 ? 1 + 2 / kPi * (x * std::sqrt(1 - x * x) + std::asin(x)) : 2;  // in discs
  return 2 * covered - 1 + std::pow(1 - covered, union_of_two);
}

double same_cell_chance(CellModel model, double x, double d) {
  switch (model) {
    case CellModel::kPoissonLines: return std::exp(-2 * x * d);
    case CellModel::kOccupancy: return occupancy(d * std::sqrt(x));
    case CellModel::kCheckerboard: return checkerboard(d / x);
    case CellModel::kHexagon: return hexagon(d / x);
    case CellModel::kTriangle: return triangle(d / x);
    case CellModel::kDelaunay:
    case CellModel::kJohnsonMehl: break;
  }
  return -1;
}

TypicalCell typical_cell(CellModel model, double x) {
  switch (model) {
    case CellModel::kPoissonLines: {
      const double area = 1 / (kPi * x * x);
      return {1 / area, area, 2 / x, 4, 1 / (2 * x * x * x * x) - area * area};
    }
    case CellModel::kOccupancy: return {x, 1 / x, 4 / std::sqrt(x), 6, 0.280 / (x * x)};
    case CellModel::kDelaunay:
      return {2 * x, 1 / (2 * x), 32 / (3 * kPi * std::sqrt(x)), 3, (35 / (8 * kPi * kPi) - 0.25) / (x * x)};
    case CellModel::kJohnsonMehl: {
      const double density = 0.8794 * std::pow(x, 2.0 / 3);
      return {density, 1 / density, 0, 0, -1};
    }
    case CellModel::kCheckerboard: return regular(4, x);
    case CellModel::kHexagon: return regular(6, x);
    case CellModel::kTriangle: break;
  }
  return regular(3, x);
}

}  // namespace tessera::statistics

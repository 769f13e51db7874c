#include "tessera/statistics/closed_forms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera::statistics {
namespace {

// 2 pi int W(d) d dd = E[A^2] / E[A] in any stationary mosaic.
TEST(ClosedFormsTest, IntegrateToTheMeanAreaAboutAPoint) {
  for (const CellModel model : {CellModel::kPoissonLines, CellModel::kOccupancy, CellModel::kCheckerboard,
                                CellModel::kHexagon, CellModel::kTriangle}) {
    const double x = model == CellModel::kPoissonLines ? 0.7 : 1.3;
    const TypicalCell cell = typical_cell(model, x);
    const double reach = (model == CellModel::kPoissonLines ? 12 : 5) * std::sqrt(cell.area);
    const int steps = model == CellModel::kPoissonLines ? 4000 : 160;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double d = reach * (i + 0.5) / steps;
      sum += 2 * kPi * d * same_cell_chance(model, x, d) * reach / steps;
    }
    const double expected = (cell.area_variance + cell.area * cell.area) / cell.area;
    EXPECT_NEAR(sum / expected, 1, 4e-3) << static_cast<int>(model);
  }
}

// W'(0) is minus the number of boundaries that a line crosses a unit length, which is 2 / pi of their length an area.
TEST(ClosedFormsTest, BeginWithTheBoundariesLength) {
  for (const auto& [model, name] : cell_models()) {
    if (same_cell_chance(model, 1, 0) < 0) continue;
    const TypicalCell cell = typical_cell(model, 0.8);
    const double d = 1e-3 * std::sqrt(cell.area);
    const double length = cell.per_area * cell.perimeter / 2;                // each is two cells'
    const double tolerance = model == CellModel::kOccupancy ? 0.06 : 0.005;  // its integral is a coarse one
    const double slope = (same_cell_chance(model, 0.8, 0) - same_cell_chance(model, 0.8, 50 * d)) / (50 * d);
    EXPECT_NEAR(slope / (2 / kPi * length), 1, 0.05 + tolerance) << name;
  }
}

TEST(ClosedFormsTest, OccupancyAsNumericalIntegrationsElsewhereHaveIt) {
  EXPECT_NEAR(same_cell_chance(CellModel::kOccupancy, 1, 0.25), 0.7001, 5e-4);
  EXPECT_NEAR(same_cell_chance(CellModel::kOccupancy, 1, 0.5), 0.4445, 5e-4);
  EXPECT_NEAR(same_cell_chance(CellModel::kOccupancy, 1, 1), 0.1182, 5e-4);
  EXPECT_NEAR(same_cell_chance(CellModel::kOccupancy, 1, 1.5), 0.0158, 5e-4);
  EXPECT_NEAR(same_cell_chance(CellModel::kOccupancy, 4, 0.5), 0.1182, 5e-4);  // only d sqrt(lambda) matters
}

TEST(ClosedFormsTest, FallFromOneToNothing) {
  for (const auto& [model, name] : cell_models()) {
    if (same_cell_chance(model, 1, 0) < 0) continue;
    EXPECT_NEAR(same_cell_chance(model, 1, 0), 1, 2e-3) << name;
    double before = 1.01;
    for (double d = 0; d < 4; d += 0.125) {
      const double chance = same_cell_chance(model, 1, d);
      EXPECT_LE(chance, before + 1e-9) << name << " " << d;
      EXPECT_GE(chance, 0);
      before = chance;
    }
    EXPECT_LT(before, 0.02) << name;
  }
}

TEST(ClosedFormsTest, DiscsCoverTwoPointsAsOneAtFirstAndIndependentlyLater) {
  for (const double covered : {0.1, 0.5, 0.9}) {
    EXPECT_NEAR(both_covered(covered, 0), covered, 1e-12);
    EXPECT_NEAR(both_covered(covered, 1), covered * covered, 1e-12);
    EXPECT_NEAR(both_covered(covered, 3), covered * covered, 1e-12);
    // The union of two discs half a diameter apart has 1 + 2 / pi (sqrt(3) / 4 + pi / 6) times the area of one.
    EXPECT_NEAR(both_covered(covered, 0.5), 2 * covered - 1 + std::pow(1 - covered, 1.6089978), 1e-7);
  }
}

// Where the formula for short needles ends, the one for long ones begins.
TEST(ClosedFormsTest, JoinWithoutAStep) {
  for (const CellModel model : {CellModel::kCheckerboard, CellModel::kHexagon, CellModel::kTriangle})
    for (const double d : {1.0, std::sqrt(3.0) / 2, std::sqrt(2.0), 2.0})
      EXPECT_NEAR(same_cell_chance(model, 1, d - 1e-6), same_cell_chance(model, 1, d + 1e-6), 1e-3) << d;
}

}  // namespace
}  // namespace tessera::statistics

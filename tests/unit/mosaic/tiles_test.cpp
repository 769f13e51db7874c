// Shapes of tiles in closed form.
#include "tessera/mosaic/tiles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera::mosaic {
namespace {

// What rows along circles around `hub` look like, which is as far away as one likes.
Fields round(Point hub) {
  Fields fields;
  fields.size = {200, 200};
  fields.torus = Torus{fields.size};
  fields.direction = DirectionField(fields.size, 2);
  cv::Mat2f& nodes = fields.direction.nodes();
  for (int j = 0; j < nodes.rows; ++j)
    for (int i = 0; i < nodes.cols; ++i) {
      const SinCos turn = sin_cos(4 * atan2_portable(2 * j - hub.y, 2 * i - hub.x));
      nodes(j, i) = {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
    }
  return fields;
}

Ring trapezoid(Point hub, Point at, double quarters = 0) {
  const Fields fields = round(hub);
  Diagram diagram;
  diagram.own = 1;
  diagram.sites = {{.x = at.x,
                    .y = at.y,
                    .angle = fields.direction.angle(at.x, at.y) + quarters * kPi / 2,
                    .extent_u = 8,
                    .extent_v = 8}};
  Params params;
  params.shape = Shape::kTrapezoid;
  params.delta = 1;
  params.clip = false;
  return shape_tiles(diagram, fields, params).at(0);
}

// Lengths of a quadrilateral's sides, the outermost first and then around; outermost is what is farthest from `hub`.
std::vector<double> sides_from_outside(const Ring& ring, Point hub) {
  std::vector<double> sides;
  std::size_t outermost = 0;
  const auto away = [&](std::size_t k) { return length(0.5 * (ring[k] + ring[(k + 1) % 4]) - hub); };
  for (std::size_t k = 1; k < 4; ++k)
    if (away(k) > away(outermost)) outermost = k;
  for (std::size_t k = 0; k < 4; ++k)
    sides.push_back(length(ring[(outermost + k + 1) % 4] - ring[(outermost + k) % 4]));
  return sides;
}

TEST(MosaicTrapezoids, WidenAsRowsFanOut) {
  const Point hub{100, 100};
  for (const double radius : {30.0, 50.0, 80.0})
    for (const double turn : {0.0, 0.4, 1.3, 2.9, 4.4})
      for (const double quarters : {0.0, 1.0, 2.0, 3.0}) {  // whichever of its axes leads across the rows
        const SinCos way = sin_cos(turn);
        const Ring ring = trapezoid(hub, hub + radius * Point{way.cos, way.sin}, quarters);
        ASSERT_EQ(ring.size(), 4u);
        const std::vector<double> sides = sides_from_outside(ring, hub);
        EXPECT_NEAR(sides[0], 16 * (1 + 8 / radius), 0.35) << radius << ' ' << turn;
        EXPECT_NEAR(sides[2], 16 * (1 - 8 / radius), 0.35) << radius << ' ' << turn;
        EXPECT_NEAR(signed_area(ring), 256, 0.1);
        EXPECT_LT(length(centroid(ring) - hub - radius * Point{way.cos, way.sin}), 0.01);
      }
}

TEST(MosaicTrapezoids, AreSquaresWhereRowsAreStraight) {
  const Point hub{-1e6, 100};
  for (const double side : sides_from_outside(trapezoid(hub, {120, 90}), hub)) EXPECT_NEAR(side, 16, 0.01);
}

// Where directions turn by leaps, tiles stay tiles.
TEST(MosaicTrapezoids, KeepTheirShorterSide) {
  const Point hub{100, 100};
  for (const double radius : {0.5, 2.0, 5.0, 9.0}) {
    const Ring ring = trapezoid(hub, {100 + radius, 100});
    ASSERT_EQ(ring.size(), 4u);
    for (const double side : sides_from_outside(ring, hub)) EXPECT_GT(side, 16 * 0.39);
    EXPECT_NEAR(signed_area(ring), 256, 0.1);
  }
}

}  // namespace
}  // namespace tessera::mosaic

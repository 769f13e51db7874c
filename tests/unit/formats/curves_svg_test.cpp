#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tessera/formats/formats.h"

namespace tessera {
namespace {

// Of the thick path of this colour.
std::vector<Point> curve_of(const std::string& svg, const std::string& colour) {
  const std::size_t style = svg.find("stroke-width=\"2\" stroke-linejoin=\"round\" stroke=\"" + colour);
  if (style == std::string::npos) return {};
  const std::size_t start = svg.rfind("d=\"M", style) + 4;
  std::string numbers = svg.substr(start, svg.find('"', start) - start);
  std::replace(numbers.begin(), numbers.end(), 'L', ' ');
  std::istringstream in(numbers);
  std::vector<Point> points;
  for (Point p; in >> p.x >> p.y;) points.push_back(p);
  return points;
}

struct Tick {
  double value, place;
};

// Those of x are in the middle of their places, those of y end beside theirs.
std::vector<Tick> ticks_of(const std::string& svg, const std::string& anchor) {
  const std::regex text("<text x=\"([^\"]*)\" y=\"([^\"]*)\" text-anchor=\"" + anchor + "\">([0-9.-]+)<");
  std::vector<Tick> ticks;
  for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end; ++at)
    ticks.push_back({std::stod((*at)[3]), anchor == "middle" ? std::stod((*at)[1]) : std::stod((*at)[2]) - 4});
  return ticks;
}

Curves rising(bool logarithmic, std::vector<Point> points) {
  return {"t", "x", "y", logarithmic, {{"s", std::move(points)}}};
}

// Between two ticks, as their values are.
double value_at(const std::vector<Tick>& ticks, double place, bool logarithmic) {
  const Tick &a = ticks.front(), &b = ticks.back();
  const double part = (place - a.place) / (b.place - a.place);
  return logarithmic ? a.value * std::pow(b.value / a.value, part) : a.value + part * (b.value - a.value);
}

TEST(WriteCurvesSvg, PointsLieWhereTheTicksSay) {
  const std::vector<Point> points = {{3, 0}, {11, 25}, {24, 60}, {170, 100}};
  for (const bool logarithmic : {false, true}) {
    const std::string svg = write_curves_svg(rising(logarithmic, points));
    const auto curve = curve_of(svg, "#2f5d8a");
    const auto xs = ticks_of(svg, "middle"), ys = ticks_of(svg, "end");
    ASSERT_EQ(curve.size(), points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_NEAR(value_at(xs, curve[k].x, logarithmic) / points[k].x, 1, 1e-3);
      EXPECT_NEAR(value_at(ys, curve[k].y, false), points[k].y, 1e-2);
    }
  }
}

TEST(WriteCurvesSvg, TicksAreRoundAndAroundAllPoints) {
  const auto values_of = [](const std::vector<Tick>& ticks) {
    std::vector<double> values;
    for (const Tick& tick : ticks) values.push_back(tick.value);
    return values;
  };
  const auto values = [&](Curves curves, const char* anchor) {
    return values_of(ticks_of(write_curves_svg(curves), anchor));
  };
  EXPECT_EQ(values(rising(true, {{3, 0}, {11, 100}}), "middle"), (std::vector<double>{2, 5, 10, 20}));
  EXPECT_EQ(values(rising(true, {{0.01, 0}, {0.01, 1}}), "middle"), (std::vector<double>{0.01, 0.02}));
  EXPECT_EQ(values(rising(true, {{999.9999999999999, 0}, {1000, 1}}), "middle"),
            (std::vector<double>{500, 1000, 2000}));
  EXPECT_EQ(values(rising(false, {{0, -3}, {9, 7}}), "end"), (std::vector<double>{-4, -2, 0, 2, 4, 6, 8}));
  EXPECT_EQ(values(rising(false, {{0, -3}, {9, 7}}), "middle"), (std::vector<double>{0, 2, 4, 6, 8, 10}));
}

TEST(WriteCurvesSvg, AMarkIsADotOnItsCurveWithItsNameEscaped) {
  Curves curves = rising(true, {{10, 0}, {20, 50}, {40, 100}});
  curves.marks = {{"D50 < 21", {20, 50}}};
  const std::string svg = write_curves_svg(curves);
  const Point middle = curve_of(svg, "#2f5d8a")[1];
  std::smatch dot;
  ASSERT_TRUE(std::regex_search(svg, dot, std::regex("<circle cx=\"([^\"]*)\" cy=\"([^\"]*)\"")));
  EXPECT_EQ(std::stod(dot[1]), middle.x);
  EXPECT_EQ(std::stod(dot[2]), middle.y);
  EXPECT_NE(svg.find(">D50 &lt; 21<"), std::string::npos);
}

TEST(WriteCurvesSvg, VeryManyPointsAreThinnedAndNoneIsFine) {
  std::vector<Point> points;
  for (int k = 0; k <= 100000; ++k) points.push_back({1 + k * 1e-3, k * 1e-3});
  const auto curve = curve_of(write_curves_svg(rising(true, points)), "#2f5d8a");
  EXPECT_LT(curve.size(), 5000U);
  EXPECT_GT(curve.size(), 500U);
  EXPECT_TRUE(std::is_sorted(curve.begin(), curve.end(), [](Point a, Point b) { return a.x < b.x || a.y > b.y; }));
  for (const bool logarithmic : {false, true}) {
    EXPECT_TRUE(curve_of(write_curves_svg(rising(logarithmic, {})), "#2f5d8a").empty());
    EXPECT_GE(ticks_of(write_curves_svg(rising(logarithmic, {})), "middle").size(), 2U);
  }
}

}  // namespace
}  // namespace tessera

// What is seen on a scan: wood, holes, marks; and how it becomes a panel.
#include "tessera/parquetry/panels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "../image_views.h"
#include "scans.h"
#include "tessera/parquetry/markers.h"
#include "tessera/parquetry/wood_mask.h"

namespace tessera::parquetry {
namespace {

using ::testing::HasSubstr;

constexpr double kMmPerPx = 25.4 / 150;

struct Lid {
  cv::Vec3b colour;
  double noise;
};

// Two boards with a hole each on a lid.
cv::Mat3b scan_of(const Lid& lid, std::uint64_t seed) {
  cv::Mat3b scan(420, 640, lid.colour);
  paint_wood(scan, {30, 30, 280, 360}, {196, 150, 96}, seed);
  paint_wood(scan, {330, 30, 280, 360}, {92, 60, 40}, seed + 1);
  paint_disc(scan, 150, 200, 12, lid.colour);
  paint_disc(scan, 480, 120, 12, lid.colour);
  add_noise(scan, lid.noise, seed);
  return scan;
}

TEST(FindWood, SeesBoardsAndHolesOnAnyLid) {
  const Lid lids[] = {
      {{244, 244, 244}, 0}, {{250, 250, 248}, 2}, {{240, 242, 244}, 6}, {{8, 8, 10}, 2}, {{120, 160, 130}, 3}};
  std::uint64_t seed = 1;
  for (const Lid& lid : lids) {
    const cv::Mat1b wood = find_wood(scan_of(lid, ++seed), kMmPerPx);
    int lost = 0, area = 0;
    for (int y = 0; y < wood.rows; ++y)
      for (int x = 0; x < wood.cols; ++x) {
        const double hole = std::min(std::hypot(x - 150, y - 200), std::hypot(x - 480, y - 120));
        const int from_side = std::min({std::abs(x - 170) - 140, std::abs(x - 470) - 140});
        const int away = std::max(from_side, std::abs(y - 210) - 180);  // > 0: off the boards
        if (away > 1 || hole < 11) {
          ASSERT_EQ(wood(y, x), 0) << x << ' ' << y << " of lid " << lid.colour;
        }
        if (away < -8 && hole > 20) {
          ++area;
          lost += wood(y, x) == 0;
        }
      }
    EXPECT_LT(lost, 0.01 * area) << lid.colour << ' ' << lid.noise;
  }
}

TEST(FindWood, WoodThatFillsTheScanIsAllWood) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    cv::Mat3b scan(300, 400);
    paint_wood(scan, {0, 0, 400, 300}, {210, 180, 130}, seed);
    add_noise(scan, static_cast<double>(seed % 3), seed);
    EXPECT_EQ(cv::countNonZero(find_wood(scan, kMmPerPx)), 300 * 400) << seed;
  }
}

TEST(FindWood, CrumbsAreNoWood) {
  cv::Mat3b scan(300, 300, cv::Vec3b(244, 244, 244));
  paint_wood(scan, {20, 20, 20, 20}, {90, 60, 40}, 3);
  paint_wood(scan, {100, 100, 150, 150}, {90, 60, 40}, 4);
  add_noise(scan, 2, 1);
  const cv::Mat1b wood = find_wood(scan, kMmPerPx);
  EXPECT_EQ(wood(30, 30), 0);
  EXPECT_EQ(wood(170, 170), 255);
}

std::vector<Point> kMarks = {{40.3, 41.8}, {600.5, 40.1}, {599.2, 380.9}, {41.7, 379.4}};

TEST(FindMarkers, FindsDiscsAndRingsToATenthOfAPixel) {
  for (const bool rings : {false, true})
    for (const double noise : {0.0, 4.0}) {
      cv::Mat3b scan(420, 640, cv::Vec3b(244, 244, 244));
      paint_wood(scan, {80, 80, 480, 260}, {92, 60, 40}, 5);
      for (const Point p : kMarks) {
        paint_disc(scan, p.x, p.y, 15, {10, 10, 10});
        if (rings) paint_disc(scan, p.x, p.y, 5, {244, 244, 244});
      }
      add_noise(scan, noise, 2);
      const auto markers = find_markers(scan, kMmPerPx);
      ASSERT_EQ(markers.size(), 4U) << rings << noise;
      for (const Marker& marker : markers) {
        double nearest = 1e9;
        for (const Point p : kMarks) nearest = std::min(nearest, length(p - marker.at));
        EXPECT_LT(nearest, 0.1) << rings << noise;
        EXPECT_NEAR(marker.diameter, 30, 1.5);
      }
    }
}

TEST(FindMarkers, FindsNoneInWoodNorSquares) {
  cv::Mat3b scan(420, 640, cv::Vec3b(244, 244, 244));
  paint_wood(scan, {100, 100, 440, 220}, {150, 110, 70}, 5);
  for (const Point p : kMarks)
    scan(cv::Rect(static_cast<int>(p.x) - 12, static_cast<int>(p.y) - 12, 24, 24)).setTo(cv::Vec3b(10, 10, 10));
  EXPECT_TRUE(find_markers(scan, kMmPerPx).empty());
  paint_disc(scan, 300, 40, 15, {0, 0, 0});  // one alone may be anything
  EXPECT_TRUE(find_markers(scan, kMmPerPx).empty());
}

cv::Mat3b marked_scan() {
  cv::Mat3b scan(420, 640, cv::Vec3b(244, 244, 244));
  paint_wood(scan, {80, 80, 480, 260}, {92, 60, 40}, 5);
  for (const Point p : kMarks) paint_disc(scan, p.x, p.y, 15, {10, 10, 10});
  add_noise(scan, 2, 2);
  return scan;
}

struct Taken {
  Result<std::vector<Panel>> panels;
  std::vector<std::string> warnings;
};

Taken taken(const std::vector<Scan>& scans, const Params& params) {
  Taken result;
  RunContext context;
  context.on_warning = [&](std::string_view message) { result.warnings.emplace_back(message); };
  result.panels = take_in(scans, params, context);
  return result;
}

TEST(TakeIn, PanelsHaveOneResolution) {
  const cv::Mat3b scan = marked_scan();
  Params params;
  params.panels = "a dpi=300; b dpi=200";
  ImageView c = view_of(scan);
  c.dpi = 600;
  auto [panels, warnings] = taken({{"a", view_of(scan)}, {"b", view_of(scan)}, {"c", c}}, params);
  ASSERT_TRUE(panels.has_value());
  EXPECT_TRUE(warnings.empty());
  const double widths[] = {640 * 25.4 / 300, 640 * 25.4 / 200, 640 * 25.4 / 600};
  for (std::size_t i = 0; i < 3; ++i) {
    const Panel& panel = (*panels)[i];
    EXPECT_DOUBLE_EQ(panel.mm_per_px, 25.4 / 150);
    EXPECT_NEAR(panel.width_mm(), widths[i], 25.4 / 150);
    EXPECT_EQ(panel.mask.size(), panel.scan.size());
  }
  params.resolution_dpi = 75;
  EXPECT_DOUBLE_EQ(taken({{"a", view_of(scan)}}, params).panels->front().mm_per_px, 25.4 / 75);
}

TEST(TakeIn, AGuessedResolutionIsSaid) {
  const cv::Mat3b scan = marked_scan();
  auto [panels, warnings] = taken({{"oak", view_of(scan)}}, {});
  ASSERT_TRUE(panels.has_value());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("oak"));
  EXPECT_THAT(warnings[0], HasSubstr("300 dpi"));
  EXPECT_THAT(warnings[0], HasSubstr("54.2 x 35.6 mm"));
  ImageView screen = view_of(scan);
  screen.dpi = 72;
  EXPECT_THAT(taken({{"oak", screen}}, {}).warnings.at(0), HasSubstr("72 dpi"));
}

TEST(TakeIn, MasksComeFromAFileOrAlpha) {
  const cv::Mat3b scan = marked_scan();
  cv::Mat3b mask(210, 320, cv::Vec3b(0, 0, 0));
  mask(cv::Rect(50, 50, 100, 60)).setTo(cv::Vec3b(255, 255, 255));
  Params params;
  params.panels = "oak dpi=150";
  auto by_file = taken({{"oak", view_of(scan), view_of(mask)}}, params).panels;
  ASSERT_TRUE(by_file.has_value());
  EXPECT_EQ(cv::countNonZero(by_file->front().mask), 200 * 120);
  EXPECT_EQ(by_file->front().mask(101, 101), 255);

  cv::Mat1b alpha(420, 640, static_cast<std::uint8_t>(0));
  alpha(cv::Rect(100, 100, 200, 120)) = 255;
  ImageView clear = view_of(scan);
  clear.alpha = alpha.ptr();
  auto by_alpha = taken({{"oak", clear}}, params).panels;
  ASSERT_TRUE(by_alpha.has_value());
  EXPECT_EQ(cv::countNonZero(by_alpha->front().mask != by_file->front().mask), 0);

  const cv::Mat3b wide(100, 320, cv::Vec3b(255, 255, 255));
  EXPECT_THAT(taken({{"oak", view_of(scan), view_of(wide)}}, params).panels.error().message, HasSubstr("320 x 100"));
  const cv::Mat3b none(420, 640, cv::Vec3b(0, 0, 0));
  EXPECT_THAT(taken({{"oak", view_of(scan), view_of(none)}}, params).panels.error().message, HasSubstr("no wood"));
}

TEST(TakeIn, MarginsAreTakenOffTheWood) {
  cv::Mat3b scan(300, 400);
  paint_wood(scan, {0, 0, 400, 300}, {210, 180, 130}, 3);
  Params params;
  params.panels = "oak dpi=150 margin=5";
  const Panel panel = taken({{"oak", view_of(scan)}}, params).panels->front();
  const int margin = static_cast<int>(5 / kMmPerPx);
  EXPECT_EQ(panel.mask(150, margin - 1), 0);
  EXPECT_EQ(panel.mask(150, margin + 2), 255);
  EXPECT_EQ(panel.mask(margin - 1, 200), 0);
}

TEST(TakeIn, MarksThatPeopleSetAreTheOnlyOnes) {
  const cv::Mat3b scan = marked_scan();
  Params params;
  params.panels = "oak dpi=300 marks=200:100,400:300";  // matched at half of that
  const Panel set = taken({{"oak", view_of(scan)}}, params).panels->front();
  ASSERT_EQ(set.fiducials.size(), 2U);
  EXPECT_NEAR(set.fiducials[0].x, 100, 1e-9);
  EXPECT_NEAR(set.fiducials[1].y, 150, 1e-9);
  EXPECT_EQ(set.mask(50, 100), 0);
  params.panels = "oak dpi=300 marks=none";
  EXPECT_TRUE(taken({{"oak", view_of(scan)}}, params).panels->front().fiducials.empty());
}

TEST(LookAt, SeesMarksAndWoodBeforeAnythingIsTakenOff) {
  const cv::Mat3b scan = marked_scan();
  Params params;
  params.panels = "oak dpi=150 margin=5";
  const Panel seen = look_at({{"oak", view_of(scan)}}, params, {})->front();
  const Panel taken_in = taken({{"oak", view_of(scan)}}, params).panels->front();
  ASSERT_EQ(seen.fiducials.size(), 4U);
  EXPECT_EQ(cv::norm(seen.mask, find_wood(scan, kMmPerPx), cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(taken_in.mask & ~seen.mask), 0);
  EXPECT_LT(cv::countNonZero(taken_in.mask), cv::countNonZero(seen.mask));
}

TEST(TakeIn, LiesOnTheMachineByItsMarks) {
  const cv::Mat3b scan = marked_scan();
  const double width = 640 * kMmPerPx;
  for (const Side side : {Side::kFront, Side::kBack}) {
    Params params;
    params.side = side;
    params.panels = "oak dpi=150 machine=";
    for (const Point p : kMarks) {
      const Point mm = kMmPerPx * p;
      params.panels +=
          std::to_string((side == Side::kBack ? width - mm.x : mm.x) + 20) + ":" + std::to_string(mm.y + 7) + ",";
    }
    params.panels.pop_back();
    auto panels = taken({{"oak", view_of(scan)}}, params).panels;
    ASSERT_TRUE(panels.has_value()) << panels.error().message;
    const Panel& panel = panels->front();
    ASSERT_TRUE(panel.registered);
    for (const double residual : panel.residuals) EXPECT_LT(residual, 0.05);
    const Point at = on_sheet(panel, side, {100, 200});
    EXPECT_NEAR(at.x, (side == Side::kBack ? width - 100 * kMmPerPx : 100 * kMmPerPx) + 20, 0.03);
    EXPECT_NEAR(at.y, 200 * kMmPerPx + 7, 0.03);
  }
}

TEST(TakeIn, MarksThatDoNotFitAreRefused) {
  const cv::Mat3b scan = marked_scan();
  Params params;
  params.panels = "oak dpi=150 machine=6.8:7.1,101.7:6.8,101.5:67";  // the last should be at 64.5
  params.side = Side::kFront;
  const auto off = taken({{"oak", view_of(scan)}}, params).panels;
  ASSERT_FALSE(off.has_value());
  EXPECT_EQ(off.error().field, "oak");
  EXPECT_THAT(off.error().message, HasSubstr("mm rms"));
  params.panels = "oak dpi=150 machine=0:0,1:0,2:0,3:0,4:0";
  EXPECT_THAT(taken({{"oak", view_of(scan)}}, params).panels.error().message, HasSubstr("4 round marks"));
}

}  // namespace
}  // namespace tessera::parquetry

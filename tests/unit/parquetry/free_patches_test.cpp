#include "tessera/parquetry/free_patches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <opencv2/imgproc.hpp>
#include <set>

#include "boards.h"
#include "tessera/base/portable_math.h"
#include "tessera/geometry/scan.h"

namespace tessera::parquetry {
namespace {

using ::testing::HasSubstr;

ImageView view_of(const cv::Mat3b& picture) {
  return {picture.data, picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
}

cv::Mat3b drawn(cv::Size size, const std::function<int(int, int)>& label) {
  cv::Mat3b picture(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int value = label(x, y);
      picture(y, x) = cv::Vec3b(value / 65536, value / 256 % 256, value % 256);
    }
  return picture;
}

// Cells of random places.
cv::Mat3b cells(Rng& rng, cv::Size size, int count) {
  std::vector<cv::Point> places;
  for (int i = 0; i < count; ++i)
    places.emplace_back(static_cast<int>(rng.uniform(0, size.width)), static_cast<int>(rng.uniform(0, size.height)));
  return drawn(size, [&](int x, int y) {
    int best = 0;
    const auto squared = [&](int i) { return (cv::Point(x, y) - places[i]).dot(cv::Point(x, y) - places[i]); };
    for (int i = 1; i < count; ++i)
      if (squared(i) < squared(best)) best = i;
    return best;
  });
}

Params narrow_params() {
  Params params;
  params.patch_mm = 20;
  params.min_width_mm = 8;  // px, where tests take a pixel for a millimetre
  return params;
}

void expect_sound(const std::vector<Patch>& patches, cv::Size size, const Params& params) {
  ASSERT_FALSE(patches.empty());
  cv::Mat1i covered(size, 0);
  double sum = 0;
  std::set<std::pair<int, int>> places;
  std::vector<Polygon> outlines;
  for (const Patch& patch : patches) {
    EXPECT_TRUE(places.insert({patch.row, patch.column}).second);
    EXPECT_EQ(patch.mask.size(), patch.box.size());
    EXPECT_EQ(patch.box & cv::Rect({0, 0}, size), patch.box);
    covered(patch.box) += (patch.mask & 1);
    for (const Point p : patch.outline.outer) {
      EXPECT_GE(p.x, patch.box.x);
      EXPECT_LE(p.x, patch.box.x + patch.box.width);
      EXPECT_GE(p.y, patch.box.y);
      EXPECT_LE(p.y, patch.box.y + patch.box.height);
    }
    sum += area(patch.outline);
    outlines.push_back(patch.outline);
  }
  EXPECT_NEAR(sum, size.area(), 1e-6);
  EXPECT_EQ(cv::countNonZero(covered != 1), 0);
  if (patches.size() > 1) {
    for (const Flaw& flaw : flaws_of(outlines, params, 1)) ADD_FAILURE() << flaw.what;
  }
}

const std::vector<std::pair<const char*, std::function<int(int, int)>>>& hostile() {
  static const std::vector<std::pair<const char*, std::function<int(int, int)>>> all = {
      {"one", [](int, int) { return 7; }},
      {"pixels", [](int x, int y) { return 1 + x + 120 * y; }},
      {"checkerboard of pixels", [](int x, int y) { return (x + y) % 2; }},
      {"checkerboard", [](int x, int y) { return (x / 20 + y / 20) % 2; }},
      {"lines", [](int x, int) { return x % 12 < 2; }},
      {"wide lines", [](int x, int) { return x % 24 < 12; }},
      {"spiral",
       [](int x, int y) {
         const double turn = atan2_portable(y - 45.3, x - 60.1) / (2 * kPi);
         const double arm = std::sqrt((x - 60.1) * (x - 60.1) + (y - 45.3) * (y - 45.3)) / 24 + turn + 1;
         return static_cast<int>(2 * (arm - std::floor(arm)));
       }},
      {"rings",
       [](int x, int y) { return static_cast<int>(std::sqrt((x - 60) * (x - 60) + (y - 45) * (y - 45)) / 11); }},
      {"thin rings",
       [](int x, int y) { return static_cast<int>(std::sqrt((x - 60) * (x - 60) + (y - 45) * (y - 45)) / 3); }},
      {"dumbbell",
       [](int x, int y) {
         return (std::abs(x - 30) < 15 || std::abs(x - 90) < 15 || std::abs(y - 45) < 2) && x > 15 && x < 105 &&
                std::abs(y - 45) < 20;
       }},
      {"wedge", [](int x, int y) { return std::abs(y - 45) < x / 6; }},
      {"islands", [](int x, int y) { return x % 30 > 8 && x % 30 < 21 && y % 30 > 8 && y % 30 < 21; }},
  };
  return all;
}

TEST(FreePatches, HostilePicturesMakeSoundPieces) {
  const cv::Size size(120, 90);
  for (const Enclosed enclosed : {Enclosed::kSplit, Enclosed::kKeep})
    for (const auto& [name, label] : hostile()) {
      SCOPED_TRACE(name);
      Params params = narrow_params();
      params.enclosed = enclosed;
      const cv::Mat3b picture = drawn(size, label);
      const auto patches = patches_of(cv::Mat3b(size), {view_of(picture)}, params, 1);
      ASSERT_TRUE(patches);
      expect_sound(*patches, size, params);
      for (const Patch& patch : *patches) EXPECT_TRUE(enclosed == Enclosed::kKeep || patch.outline.holes.empty());
    }
}

TEST(FreePatches, RandomPicturesMakeSoundPieces) {
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed, RngPurpose::kShapes);
    const cv::Size size(static_cast<int>(rng.uniform(40, 150)), static_cast<int>(rng.uniform(40, 150)));
    const cv::Size coarse = seed % 3 == 0 ? cv::Size(size.width / 2, size.height / 2) : size;
    const cv::Mat3b picture = seed % 2 == 0 ? cells(rng, coarse, 5 + seed) : blotches(rng, coarse, 2);
    Params params = narrow_params();
    params.min_width_mm = rng.uniform(2, 10);
    const auto patches = patches_of(cv::Mat3b(size), {view_of(picture)}, params, 1);
    if (coarse != size && !patches) continue;  // odd sides
    ASSERT_TRUE(patches);
    expect_sound(*patches, size, params);
  }
}

TEST(FreePatches, WideRegionsStayAsTheyAre) {
  const cv::Size size(120, 90);
  const cv::Mat3b picture = drawn(size, [](int x, int y) { return x / 30 + 4 * (y / 30); });
  Params params = narrow_params();
  params.thin_parts = ThinParts::kRefuse;
  const auto patches = patches_of(cv::Mat3b(size), {view_of(picture)}, params, 1);
  ASSERT_TRUE(patches);
  ASSERT_EQ(patches->size(), 12U);
  for (const Patch& patch : *patches) {
    EXPECT_EQ(patch.box.size(), cv::Size(30, 30));
    EXPECT_EQ(cv::countNonZero(patch.mask), 900);
    EXPECT_EQ(patch.box.tl(), cv::Point(30 * patch.column, 30 * patch.row));
  }
}

TEST(FreePatches, ARingKeepsItsHoleOrIsSplit) {
  const cv::Size size(120, 90);
  const cv::Mat3b picture = drawn(size, [](int x, int y) {
    const int squared = (x - 60) * (x - 60) + (y - 45) * (y - 45);
    return (squared < 100) + (squared < 900);
  });
  Params params = narrow_params();
  params.enclosed = Enclosed::kKeep;
  const auto kept = patches_of(cv::Mat3b(size), {view_of(picture)}, params, 1);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->size(), 3U);
  params.enclosed = Enclosed::kSplit;
  const auto split = patches_of(cv::Mat3b(size), {view_of(picture)}, params, 1);
  ASSERT_TRUE(split);
  EXPECT_EQ(split->size(), 5U);
}

TEST(FreePatches, RefusedWithAllPlaces) {
  const cv::Size size(120, 90);
  const cv::Mat3b picture = drawn(size, [](int x, int y) { return (x >= 50 && x < 53) + 2 * (y >= 80 && y < 84); });
  Params params = narrow_params();
  params.thin_parts = ThinParts::kRefuse;
  const auto patches = patches_of(cv::Mat3b(size), {view_of(picture)}, params, 0.5);
  ASSERT_FALSE(patches);
  EXPECT_EQ(patches.error().code, StatusCode::kInvalidInput);
  EXPECT_EQ(patches.error().field, "segmentation");
  EXPECT_THAT(patches.error().message, HasSubstr("only 1.5 mm wide at (25.8"));
  EXPECT_THAT(patches.error().message, HasSubstr("only 2.0 mm wide at"));
  EXPECT_THAT(patches.error().message, HasSubstr("minWidthMm"));
}

TEST(FreePatches, OtherProportionsAndTooManyRegionsAreRefused) {
  const auto wrong = patches_of(cv::Mat3b(90, 120), {view_of(cv::Mat3b(90, 110))}, narrow_params(), 1);
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().message, HasSubstr("110 x 90"));
  const cv::Mat3b noise = drawn({500, 500}, [](int x, int y) { return (x + y) % 2; });
  const auto many = patches_of(cv::Mat3b(500, 500), {view_of(noise)}, narrow_params(), 1);
  ASSERT_FALSE(many);
  EXPECT_THAT(many.error().message, HasSubstr("250000 regions"));
}

TEST(Posterize, FollowsTonesAndSplitsLargeRegions) {
  cv::Mat3b target(100, 140, cv::Vec3b(40, 40, 40));
  target(cv::Rect(60, 0, 80, 100)).setTo(cv::Vec3b(220, 220, 220));
  target(cv::Rect(20, 40, 3, 3)).setTo(cv::Vec3b(255, 255, 255));  // a detail too small to cut
  Params params = narrow_params();
  params.posterize = 2;
  auto patches = patches_of(target, {}, params, 1);
  ASSERT_TRUE(patches);
  EXPECT_EQ(patches->size(), 2U);
  params.largest_patch = 2.5;  // 50 mm: 60 x 100 in 4, 80 x 100 in 4
  patches = patches_of(target, {}, params, 1);
  ASSERT_TRUE(patches);
  EXPECT_EQ(patches->size(), 8U);
  expect_sound(*patches, target.size(), params);
  for (const Patch& patch : *patches) EXPECT_LE(std::max(patch.box.width, patch.box.height), 52);
}

TEST(Regions, AreTheConnectedPartsOfEqualValues) {
  for (int seed = 1; seed <= 30; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    cv::Mat1i values(20, 25);
    for (int& value : values) value = static_cast<int>(rng.uniform(0, 2 + seed % 3)) * 1000 - 500;
    const Regions regions = regions_of(values);
    for (int y = 0; y < values.rows; ++y)
      for (int x = 1; x < values.cols; ++x)
        EXPECT_EQ(values(y, x) == values(y, x - 1), regions.labels(y, x) == regions.labels(y, x - 1));
    double largest = 0;
    cv::minMaxLoc(regions.labels, nullptr, &largest);
    EXPECT_EQ(largest, regions.count - 1);
    // Each is what a flood from its first pixel fills.
    for (int region = 0; region < regions.count; ++region) {
      const cv::Mat1b mask = regions.labels == region;
      cv::Mat1i parts;
      EXPECT_EQ(cv::connectedComponents(mask, parts, 4), 2);
    }
  }
}

// What is looked for has any shape; the best place is that of brute force.
TEST(FreePatches, AreMatchedExactly) {
  for (int seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed, RngPurpose::kShapes);
    Params params = narrow_params();
    params.rotations = 1 + seed % 4;
    params.min_width_mm = 6;
    params.clearance_mm = rng.uniform(0, 2);
    params.enclosed = Enclosed::kKeep;
    const std::vector<Panel> panels{board(rng, {90, 80}, seed % 5)};
    const cv::Mat3b target = blotches(rng, {60, 50});
    cv::Mat3b picture = cells(rng, target.size(), 8);
    if (seed % 2 == 0) cv::circle(picture, {30, 25}, 12, {9, 9, 9}, -1);
    if (seed % 4 == 0) cv::circle(picture, {30, 25}, 4, {5, 5, 5}, -1);
    const auto patches = patches_of(target, {view_of(picture)}, params, 1);
    ASSERT_TRUE(patches);
    Workshop workshop(panels, {target}, *patches, params);
    const SlowMatcher slow(panels, target, params);
    Wood wood = workshop.fresh_wood();
    SlowWood slow_wood(panels, params);
    for (std::size_t i = 0; i < std::min<std::size_t>(4, patches->size()); ++i) {
      const Template piece = workshop.template_of((*patches)[i]);
      const auto found = workshop.matcher().best(piece, wood);
      const auto expected = slow.best((*patches)[i], slow_wood);
      ASSERT_EQ(found.has_value(), expected.has_value());
      if (!found) continue;
      EXPECT_EQ(found->cost, expected->cost);
      EXPECT_EQ(found->view, expected->view);
      EXPECT_EQ(found->at, expected->at);
      const int panel = slow.views[found->view].panel;
      wood.take(static_cast<int>(i), panel, workshop.cut_of(piece, *found));
      slow_wood.cuts.emplace_back(panel, workshop.cut_of(piece, *found));
    }
  }
}

}  // namespace
}  // namespace tessera::parquetry

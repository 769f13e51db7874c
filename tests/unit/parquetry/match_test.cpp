#include "tessera/parquetry/match.h"

#include <gtest/gtest.h>

#include "boards.h"

namespace tessera::parquetry {
namespace {

Params random_params(Rng& rng) {
  Params params;
  params.rotations = 1 + static_cast<int>(rng.uniform(0, 6));
  params.kerf_mm = rng.uniform(0, 1.5);
  params.clearance_mm = rng.uniform() < 0.2 ? 0 : rng.uniform(0, 4);
  params.min_width_mm = 1;
  params.weight_edge = rng.uniform() < 0.2 ? 0 : 0.5;
  params.weight_colour = rng.uniform() < 0.3 ? 0.4 : 0;
  return params;
}

cv::Size random_size(Rng& rng, int least, int most) {
  return {static_cast<int>(rng.uniform(least, most)), static_cast<int>(rng.uniform(least, most))};
}

Patch random_patch(Rng& rng, cv::Size target) {
  const cv::Size size = random_size(rng, 6, 40);
  const cv::Rect box(static_cast<int>(rng.uniform(0, target.width - size.width)),
                     static_cast<int>(rng.uniform(0, target.height - size.height)), size.width, size.height);
  if (rng.uniform() < 0.6) return odd_patch(rng, box);
  Params whole;
  whole.patch_mm = 100;
  Patch patch = grid_patches(size, whole, 1)[0];
  patch.box = box;
  for (Point& p : patch.outline.outer) p += Point{static_cast<double>(box.x), static_cast<double>(box.y)};
  return patch;
}

void expect_same(const std::optional<Match>& found, const std::optional<Match>& expected) {
  ASSERT_EQ(found.has_value(), expected.has_value());
  if (!found) return;
  EXPECT_EQ(found->cost, expected->cost);
  EXPECT_EQ(found->view, expected->view);
  EXPECT_EQ(found->at, expected->at);
}

// Panels, masks, shapes, kerfs, clearances and what has been cut before, all at random.
TEST(Match, IsTheBestOfAllPlaces) {
  int without = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed, RngPurpose::kShapes);
    const Params params = random_params(rng);
    std::vector<Panel> panels;
    for (int i = 0; i < 1 + seed % 2; ++i)
      panels.push_back(board(rng, random_size(rng, 20, 90), static_cast<int>(rng.uniform(0, 6))));
    const cv::Mat3b target = blotches(rng, random_size(rng, 40, 70));
    std::vector<Patch> patches;
    for (int i = 0; i < 4; ++i) patches.push_back(random_patch(rng, target.size()));
    Workshop workshop(panels, {target}, patches, params);
    const SlowMatcher slow(panels, target, params);
    Wood wood = workshop.fresh_wood();
    SlowWood slow_wood(panels, params);
    for (int i = 0; i < static_cast<int>(patches.size()); ++i) {
      const Template piece = workshop.template_of(patches[i]);
      const auto found = workshop.matcher().best(piece, wood);
      expect_same(found, slow.best(patches[i], slow_wood));
      if (!found) {
        ++without;
        continue;
      }
      // What costs no more than that is found too, what costs less is not.
      expect_same(workshop.matcher().best(piece, wood, found->cost), found);
      EXPECT_FALSE(workshop.matcher().best(piece, wood, found->cost - 1));
      const int panel = slow.views[found->view].panel;
      wood.take(i, panel, workshop.cut_of(piece, *found));
      slow_wood.cuts.emplace_back(panel, workshop.cut_of(piece, *found));
    }
  }
  EXPECT_GT(without, 5);  // both happen
  EXPECT_LT(without, 200);
}

// Wood that is all alike: every place costs the same, the first one is taken.
TEST(Match, OfEqualPlacesIsTheFirst) {
  Rng rng(1, RngPurpose::kShapes);
  Panel panel = board(rng, {40, 40}, 0);
  panel.scan.setTo(cv::Scalar(90, 80, 70));
  Params params;
  params.rotations = 4;
  params.kerf_mm = 0;
  params.clearance_mm = 3;
  const std::vector<Panel> panels{panel, panel};
  const Patch patch = grid_patches({10, 10}, params, 1)[0];
  Workshop workshop(panels, {cv::Mat3b(10, 10, cv::Vec3b(50, 50, 50))}, {patch}, params);
  const auto found = workshop.matcher().best(workshop.template_of(patch), workshop.fresh_wood());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->view, 0);
  EXPECT_EQ(found->at, cv::Point(3, 3));
}

TEST(Match, FindsAPieceOfTheWoodItself) {
  Rng rng(5, RngPurpose::kShapes);
  Params params;
  params.rotations = 8;
  params.weight_histogram = 0;
  const std::vector<Panel> panels{board(rng, {150, 120}, 3)};
  const cv::Rect there(70, 40, 33, 29);
  const cv::Mat3b target = panels[0].scan(there).clone();
  Params whole = params;
  whole.weight_edge = 0;  // at the target's border edges are not the panel's
  whole.patch_mm = 100;
  const Patch patch = grid_patches(target.size(), whole, 1)[0];
  Workshop workshop(panels, {target}, {patch}, whole);
  Wood wood = workshop.fresh_wood();
  const Template piece = workshop.template_of(patch);
  const auto found = workshop.matcher().best(piece, wood);
  ASSERT_TRUE(found);
  if (wood.fits(0, workshop.cut_of(piece, {0, 0, there.tl()}))) {
    EXPECT_EQ(found->cost, 0);
    EXPECT_EQ(found->at, there.tl());
  }
}

}  // namespace
}  // namespace tessera::parquetry

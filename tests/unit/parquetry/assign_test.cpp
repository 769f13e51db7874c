#include "tessera/parquetry/assign.h"

#include <gtest/gtest.h>

#include "boards.h"
#include "tessera/parquetry/run.h"

namespace tessera::parquetry {
namespace {

struct Scene {
  std::vector<Panel> panels;
  Request request;
  Params params;
};

// A target of 4 x 3 patches of 12 px, and wood for more than these, or for fewer.
Scene scene(int seed, cv::Size wood = {110, 90}) {
  Scene made;
  Rng rng(seed, RngPurpose::kShapes);
  made.params.patch_mm = 12;
  made.params.min_width_mm = 3;
  made.params.rotations = 5;
  made.panels = {board(rng, wood, 3)};
  made.request.targets = {blotches(rng, {48, 36})};
  made.request.patches = grid_patches({48, 36}, made.params, 1);
  return made;
}

Output output_of(const Scene& scene, const LaidObserver& observer = {}) {
  return run(scene.panels, scene.request, scene.params, {}, observer).value();
}

void expect_same(const Output& a, const Output& b) {
  ASSERT_EQ(a.placements.size(), b.placements.size());
  EXPECT_EQ(a.cost, b.cost);
  for (std::size_t i = 0; i < a.placements.size(); ++i) {
    EXPECT_EQ(a.patches[i].box, b.patches[i].box);
    EXPECT_EQ(a.placements[i].panel, b.placements[i].panel);
    EXPECT_EQ(a.placements[i].rotation, b.placements[i].rotation);
    EXPECT_EQ(a.placements[i].at, b.placements[i].at);
    EXPECT_EQ(a.placements[i].cost, b.placements[i].cost);
  }
}

// All cuts lie in the wood and keep their distance, and cost what they are said to.
void expect_valid(const Scene& scene, const Output& output) {
  SlowWood wood(scene.panels, scene.params);
  const SlowMatcher slow(scene.panels, scene.request.targets[0], scene.params);
  for (std::size_t i = 0; i < output.patches.size(); ++i) {
    const Placement& placement = output.placements[i];
    EXPECT_EQ(placement.patch, static_cast<int>(i));
    if (placement.panel < 0) continue;
    const Ring cut = on_panel(placement, shape_of(output.patches[i], 0.5 * scene.params.kerf_mm).cut).outer;
    EXPECT_TRUE(wood.fits(placement.panel, cut)) << i;
    wood.cuts.emplace_back(placement.panel, cut);
    const auto view = std::find_if(slow.views.begin(), slow.views.end(), [&](const View& v) {
      return v.panel == placement.panel && v.rotation == placement.rotation;
    });
    EXPECT_EQ(placement.cost,
              slow_cost(output.patches[i], slow.features, slow.frames[view - slow.views.begin()], placement.at));
  }
}

TEST(Greedy, IsWhatTryingAllPlacesGives) {
  for (int seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    Scene rows = scene(seed, seed % 2 == 0 ? cv::Size(60, 50) : cv::Size(100, 80));
    rows.params.order = Order::kRows;
    const Output output = output_of(rows);
    const SlowMatcher slow(rows.panels, rows.request.targets[0], rows.params);
    SlowWood wood(rows.panels, rows.params);
    for (std::size_t i = 0; i < output.patches.size(); ++i) {
      const auto expected = slow.best(output.patches[i], wood);
      ASSERT_EQ(output.placements[i].panel >= 0, expected.has_value()) << i;
      if (!expected) continue;
      EXPECT_EQ(output.placements[i].cost, expected->cost);
      EXPECT_EQ(output.placements[i].at, expected->at);
      EXPECT_EQ(output.placements[i].rotation, slow.views[expected->view].rotation);
      const Shape shape = shape_of(output.patches[i], slow.half_kerf);
      const View& view = slow.views[expected->view];
      wood.cuts.emplace_back(view.panel, cut_at(shape, view.turn, view.rotation, expected->at).outer);
    }
  }
}

TEST(Greedy, SaysWhatFoundNoWood) {
  Scene small = scene(3, {40, 34});
  const Output output = output_of(small);
  expect_valid(small, output);
  EXPECT_GT(output.without_wood, 0);
  EXPECT_LT(output.without_wood, 12);
  int counted = 0;
  for (const Placement& placement : output.placements) counted += placement.panel < 0;
  EXPECT_EQ(counted, output.without_wood);

  small = scene(3, {10, 9});  // smaller than a patch
  EXPECT_EQ(output_of(small).without_wood, 12);
  small = scene(3);
  small.panels[0].mask.setTo(0);
  EXPECT_EQ(output_of(small).without_wood, 12);
}

TEST(Greedy, IsTheSameForAnyNumberOfThreads) {
  const Scene usual = scene(4);
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const Output one = output_of(usual);
  cv::setNumThreads(4);
  const Output four = output_of(usual);
  cv::setNumThreads(before);
  expect_same(one, four);
}

TEST(Greedy, GoesOnWhereItWasStopped) {
  Scene usual = scene(5);
  usual.params.adaptive_levels = 1;
  std::vector<std::vector<Laid>> told;
  const Output whole = output_of(usual, [&](const std::vector<Laid>& laid) { told.push_back(laid); });
  ASSERT_EQ(told.size(), 12u);
  for (const std::size_t stopped : {std::size_t{1}, std::size_t{7}, std::size_t{12}}) {
    usual.request.earlier.clear();
    for (std::size_t i = 0; i < stopped; ++i)
      usual.request.earlier.insert(usual.request.earlier.end(), told[i].begin(), told[i].end());
    std::size_t again = 0;
    expect_same(output_of(usual, [&](const std::vector<Laid>&) { ++again; }), whole);
    EXPECT_EQ(again, 12 - stopped);
  }
}

TEST(Greedy, StopsWhenAsked) {
  const Scene usual = scene(5);
  std::atomic<int> stop{0};
  RunContext context;
  context.stop = &stop;
  int laid = 0;
  const auto output = run(usual.panels, usual.request, usual.params, context, [&](const std::vector<Laid>&) {
    if (++laid == 3) stop = static_cast<int>(StopReason::kCancelled);
  });
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, StatusCode::kCancelled);
  EXPECT_EQ(laid, 3);
}

// One patch and wood for it: it is quartered where the factor times its cost is above that of the quarters, and not
// where it is equal or below.
TEST(Adaptive, QuartersWhereThatCostsLessThanTheFactorSays) {
  Scene one = scene(6);
  one.request.patches = {one.request.patches[5]};
  const Output whole = output_of(one);
  one.params.adaptive_levels = 1;
  one.params.adaptive_factor = 100;
  const Output parts = output_of(one);
  ASSERT_EQ(parts.patches.size(), 4u);
  EXPECT_EQ(parts.quartered, 1);
  expect_valid(one, parts);
  const double ratio = static_cast<double>(parts.cost) / static_cast<double>(whole.cost);
  one.params.adaptive_factor = ratio * (1 + 1e-6);
  EXPECT_EQ(output_of(one).patches.size(), 4u);
  one.params.adaptive_factor = ratio * (1 - 1e-6);
  EXPECT_EQ(output_of(one).patches.size(), 1u);
  // A quarter narrower than the least width is none.
  one.params.adaptive_factor = 100;
  one.params.min_width_mm = 7;
  EXPECT_EQ(output_of(one).patches.size(), 1u);
}

TEST(Improve, NeverCostsMoreAndStaysValidWhereverItStops) {
  int rounds = 0, exchanges = 0, gains = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    Scene scarce = scene(seed, {80, 60});
    const Output greedy = output_of(scarce);
    for (const int tries : {1, 20, 120}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << tries << " tries");
      int asked = 0;
      scarce.request.improve = [&] { return asked++ < tries; };
      const Output output = output_of(scarce);
      expect_valid(scarce, output);
      EXPECT_EQ(output.greedy_cost, greedy.cost);
      EXPECT_LE(output.without_wood, greedy.without_wood);
      if (output.without_wood == greedy.without_wood) {
        EXPECT_LE(output.cost, greedy.cost);
      }
      rounds += output.rounds;
      exchanges += output.exchanges;
      gains += output.without_wood < greedy.without_wood || output.cost < greedy.cost;
    }
  }
  EXPECT_GT(rounds, 0);
  EXPECT_GT(exchanges, 0);
  EXPECT_GT(gains, 0);
}

TEST(Run, RefusesWhatHasNoPixels) {
  Scene broken = scene(1);
  broken.request.targets = {cv::Mat3b()};
  EXPECT_EQ(run(broken.panels, broken.request, broken.params, {}).error().field, "target");
  EXPECT_EQ(run({}, scene(1).request, broken.params, {}).error().field, "panel");
}

}  // namespace
}  // namespace tessera::parquetry

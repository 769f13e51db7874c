// What a parquetry's run leaves for the next one, and what it tells of its panels.
#include "tessera/job/parquet_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tessera/base/rng.h"
#include "tessera/formats/formats.h"
#include "tessera/job/parameters.h"
#include "tessera/job/techniques.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera {
namespace {

using ::testing::HasSubstr;

cv::Mat3b noise(cv::Size size, int seed) {
  Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kNoise);
  cv::Mat3b picture(size);
  for (cv::Vec3b& pixel : picture) pixel = cv::Vec3b::all(static_cast<std::uint8_t>(rng.uniform(0, 255)));
  return picture;
}

ImageView view_of(const cv::Mat3b& picture) {
  return {picture.ptr(), picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
}

class ParquetJobTest : public ::testing::Test {
 protected:
  ParquetJobTest() {
    params.image_size_mm = 40;
    params.patch_mm = 10;
    params.rotations = 3;
    params.panels = "oak dpi=25.4";  // a millimetre a pixel
  }

  tl::expected<Outcome, Problems> run(std::string_view earlier = {}, bool if_fits = true) {
    stages.clear();
    RunContext context;
    context.on_stage = [this](std::string_view name) { stages.emplace_back(name); };
    context.earlier = earlier;
    context.earlier_if_fits = if_fits;
    return compute_job({1, params, {}}, pictures(), *make_cpu_rasterizer(), context);
  }

  Pictures pictures() const { return {{"target", view_of(target)}, {"panel-oak", view_of(panel)}}; }

  bool matched() const { return std::count(stages.begin(), stages.end(), "matching") != 0; }

  // Every file but the job, by content.
  static std::vector<std::string> files_of(const Outcome& outcome) {
    std::vector<std::string> bytes;
    for (const Artifact& file : outcome.folder()) bytes.push_back(file.name + '\n' + file.bytes);
    return bytes;
  }

  parquetry::Params params;
  cv::Mat3b target = noise({40, 40}, 1), panel = noise({100, 80}, 2);
  std::vector<std::string> stages;
};

// A pixel of it to one of the boards'.
TEST_F(ParquetJobTest, ItsPictureIsThatOfItsFolder) {
  const auto made = run();
  ASSERT_TRUE(made);
  std::string preview;
  for (const Artifact& file : made->folder())
    if (file.name == "preview.png") preview = file.bytes;
  EXPECT_EQ(write_png(draw_picture(*made, 1)), preview);
}

TEST_F(ParquetJobTest, BeginsItsGridForPeopleToWorkOn) {
  std::unique_ptr<parquetry::LiveGrid> grid;
  const auto begin = [&](const Pictures& given) { return begin_live_grid({1, params, {}}, given, grid); };
  const auto regular = begin(pictures());
  ASSERT_FALSE(regular);
  EXPECT_EQ(regular.error().field, "grid");
  params.grid = parquetry::GridKind::kMorphed;
  EXPECT_EQ(begin({{"panel-oak", view_of(panel)}}).error().field, "target");
  ASSERT_TRUE(begin(pictures()));
  EXPECT_EQ(grid->mm_per_px(), 1);
  EXPECT_EQ(grid->size(), cv::Size(40, 40));
  EXPECT_EQ(grid->grid().across(), 4);
  // What has been found is kept while it is right.
  const parquetry::LiveGrid* const first = grid.get();
  const cv::Mat3b black(10, 10, cv::Vec3b(0, 0, 0)), wide(10, 20);
  Pictures masked = pictures();
  masked["edge-mask"] = view_of(black);
  ASSERT_TRUE(begin(masked));
  EXPECT_EQ(grid.get(), first);
  EXPECT_EQ(cv::countNonZero(grid->counting().bilateral), 0);
  masked["edge-mask"] = view_of(wide);
  EXPECT_EQ(begin(masked).error().field, "edge-mask");
  params.patch_mm = 20;
  ASSERT_TRUE(begin(pictures()));
  EXPECT_EQ(grid->grid().across(), 2);
}

// A place that no run gives: of another panel or rotation, off the panel, or with another turn than its rotation's.
TEST_F(ParquetJobTest, AStateThatSomebodyHasChangedIsRefused) {
  const auto first = run();
  ASSERT_TRUE(first.has_value());
  const std::string& state = first->state;
  std::size_t line = state.find('\n', state.find('\n') + 1) + 1;
  const std::size_t end = state.find('\n', line);
  const std::string head = state.substr(0, line), tail = state.substr(end);
  std::vector<std::string> numbers;
  for (std::size_t next = 0; line < end; line = next + 1) {
    next = std::min(state.find(' ', line), end);
    numbers.push_back(state.substr(line, next - line));
  }
  ASSERT_EQ(numbers.size(), 19u);
  const auto with = [&](std::size_t place, const std::string& value) {
    std::string text = head;
    for (std::size_t i = 0; i < numbers.size(); ++i) text += (i > 0 ? " " : "") + (i == place ? value : numbers[i]);
    return text + tail;
  };
  ASSERT_TRUE(run(with(9, numbers[9]), false).has_value());
  const std::vector<std::pair<std::size_t, const char*>> changes = {
      {9, "1"},   {9, "-2"},   {9, "1e12"}, {10, "3"}, {10, "-1"},   {11, "-1"},    {11, "1000"}, {12, "1e9"},
      {14, "17"}, {15, "nan"}, {17, "1e9"}, {3, "2"},  {5, "1e300"}, {7, "999999"}, {13, "1e19"}, {18, "oak"}};
  for (const auto& [place, value] : changes) {
    const auto again = run(with(place, value), false);
    ASSERT_FALSE(again.has_value()) << place << ' ' << value;
    EXPECT_EQ(again.error().front().code, StatusCode::kInvalidInput);
  }
}

TEST_F(ParquetJobTest, WhatComesAfterMatchingTakesNoMatching) {
  const auto first = run();
  ASSERT_TRUE(first.has_value());
  EXPECT_TRUE(matched());
  ASSERT_FALSE(first->state.empty());
  const std::string state = first->state;
  for (int change = 0; change < 4; ++change) {
    SCOPED_TRACE(change);
    const parquetry::Params before = params;
    if (change == 1) params.side = parquetry::Side::kFront;
    if (change == 2) params.cut_speed = 7;
    if (change == 3) params.registration = parquetry::Registration::kAffine;
    const auto again = run(state, false);
    ASSERT_TRUE(again.has_value());
    EXPECT_FALSE(matched());
    EXPECT_EQ(again->state, state);
    const auto fresh = run();
    EXPECT_TRUE(matched());
    EXPECT_EQ(files_of(*again), files_of(*fresh));
    EXPECT_EQ(again->counts, fresh->counts);
    EXPECT_EQ(again->metrics, fresh->metrics);
    params = before;
  }
}

TEST_F(ParquetJobTest, WhatMatchingDependsOnIsMatchedAnew) {
  const std::string state = run()->state;
  for (int change = 0; change < 6; ++change) {
    SCOPED_TRACE(change);
    const parquetry::Params before = params;
    const cv::Mat3b wood = panel.clone();
    if (change == 0) params.patch_mm = 8;
    if (change == 1) params.kerf_mm = 0.5;
    if (change == 2) params.panels = "oak dpi=25.4 margin=5";
    if (change == 3) params.panels = "oak dpi=26";
    if (change == 4) params.copies = 2;
    if (change == 5) panel(3, 4)[1] ^= 1;
    const auto again = run(state);
    ASSERT_TRUE(again.has_value());
    EXPECT_TRUE(matched());
    EXPECT_EQ(files_of(*again), files_of(*run()));
    const auto refused = run(state, false);
    ASSERT_FALSE(refused.has_value());
    EXPECT_THAT(refused.error().front().message, HasSubstr("another job"));
    params = before;
    panel = wood;
  }
}

TEST_F(ParquetJobTest, TellsOfItsPanels) {
  const auto& questions = find_technique("parquetry")->questions;
  const auto masks =
      std::find_if(questions.begin(), questions.end(), [](const Question& q) { return q.name == "masks"; });
  ASSERT_NE(masks, questions.end());
  cv::Mat3b half(80, 100, cv::Vec3b(0, 0, 0));
  half.colRange(30, 100).setTo(cv::Scalar(255, 255, 255));
  params.panels = "oak dpi=25.4 margin=9 marks=20:30,50:60.5";
  Pictures given = {{"panel-oak", view_of(panel)}, {"mask-oak", view_of(half)}};
  const auto answer = masks->answer({1, params, {}}, given, {});
  ASSERT_TRUE(answer.has_value());
  const Json told = Json::parse(*answer);
  EXPECT_EQ(told["panel"], "oak");
  EXPECT_EQ(told["width"], 100);
  EXPECT_EQ(told["height"], 80);
  EXPECT_EQ(told["marks"], Json::parse("[[20.0, 30.0], [50.0, 60.5]]"));
  const auto runs = told["wood"].get<std::vector<int>>();
  ASSERT_EQ(runs.size(), 160U);  // 30 without and 70 with, in each row
  for (std::size_t i = 0; i < runs.size(); ++i) EXPECT_EQ(runs[i], i % 2 == 0 ? 30 : 70);
  given.clear();
  EXPECT_EQ(masks->answer({1, params, {}}, given, {}).error().field, "panel");
}

}  // namespace
}  // namespace tessera

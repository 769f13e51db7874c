#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <new>

#include "tessera/job/job_json.h"
#include "tessera/job/techniques.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A black disc on white.
class Drawing {
 public:
  Drawing(int width, int height)
      : width_(width), height_(height), rgb_(static_cast<std::size_t>(3 * width * height), 255) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double u = x + 0.5 - width / 2.0, v = y + 0.5 - height / 2.0;
        if (u * u + v * v > height * height / 9.0) continue;
        std::fill_n(rgb_.begin() + 3 * (y * width + x), 3, std::uint8_t{0});
      }
    }
  }
  ImageView view() const { return {rgb_.data(), width_, height_, 3 * width_}; }

 private:
  int width_, height_;
  std::vector<std::uint8_t> rgb_;
};

// Fails in whatever way it is told to.
class FailingRasterizer : public Rasterizer {
 public:
  explicit FailingRasterizer(std::function<Result<void>()> fails) : fails_(std::move(fails)) {}
  std::string_view name() const override { return "failing"; }
  Result<void> begin(const cv::Mat1b&, Metric, double) override { return {}; }
  Result<void> label(const Sites&, LabelMap&) override { return fails_(); }

 private:
  std::function<Result<void>()> fails_;
};

class RunJobTest : public ::testing::Test {
 protected:
  tl::expected<JobResult, Problems> run(const JobRequest& request, const RunContext& context = {}) {
    return run_job(job_, pictures_, request, *rasterizer_, context);
  }
  // The only problem of a run that fails.
  Status failure(const JobRequest& request = {{"svg"}}, const RunContext& context = {}) {
    const auto result = run(request, context);
    EXPECT_FALSE(result.has_value());
    if (result) return {};
    EXPECT_EQ(result.error().size(), 1u);
    return result.error().front();
  }

  Drawing drawing_{96, 64};
  Job job_{.seed = 5, .params = pavement::Params{.iterations = 4}, .inputs = {{"drawing", "disc.png"}}};
  Pictures pictures_{{"drawing", drawing_.view()}};
  std::unique_ptr<Rasterizer> rasterizer_ = make_cpu_rasterizer();
};

TEST_F(RunJobTest, MakesEveryArtifactInTheOrderAskedFor) {
  const auto result = run({.formats = {"csv", "svg", "png", "json", "dxf", "svg"}, .plots = true});
  ASSERT_TRUE(result.has_value()) << result.error().front().message;
  std::vector<std::string> names, types;
  for (const Artifact& artifact : result->artifacts) {
    names.push_back(artifact.name);
    types.push_back(artifact.media_type);
    EXPECT_FALSE(artifact.bytes.empty()) << artifact.name;
  }
  EXPECT_THAT(names, ElementsAre("csv", "svg", "png", "json", "dxf", "svg", "plots/vertices.svg", "plots/areas.svg"));
  EXPECT_EQ(types[2], "image/png");
  EXPECT_THAT(result->artifacts[2].bytes, StartsWith("\x89PNG"));
  EXPECT_EQ(result->artifacts[1].bytes, result->artifacts[5].bytes);
  EXPECT_TRUE(Json::accept(result->artifacts[3].bytes));
}

TEST_F(RunJobTest, CountsWhatItMade) {
  const auto result = run({});
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(result->artifacts.empty());
  std::int64_t by_vertices = 0;
  for (const auto& [name, count] : result->counts) {
    if (name.rfind("stones_with_", 0) == 0) by_vertices += count;
  }
  EXPECT_GT(result->counts.at("stones"), 0);
  EXPECT_EQ(result->counts.at("stones"), by_vertices);
  EXPECT_GT(result->counts.at("sites"), 0);
  EXPECT_GE(result->counts.at("reseeded"), 0);
  EXPECT_GT(result->metrics.at("area_mean"), 0);
  EXPECT_GE(result->metrics.at("area_cv"), 0);
  EXPECT_LE(result->metrics.at("quad_fraction"), 1);
}

TEST_F(RunJobTest, TheSvgHoldsTheJobThatMakesItAgain) {
  const auto first = run({.formats = {"svg"}});
  ASSERT_TRUE(first.has_value());
  const auto job = read_job(first->artifacts[0].bytes);
  ASSERT_TRUE(job.has_value());
  EXPECT_EQ(job_to_text(*job), job_to_text(job_));
  const auto again = run_job(*job, pictures_, {.formats = {"svg"}}, *rasterizer_, {});
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->artifacts[0].bytes, first->artifacts[0].bytes);
}

TEST_F(RunJobTest, ReportsAllProblemsTogether) {
  job_.params = pavement::Params{.half_side = 0, .colors = 1};
  job_.seed = kMaxSeed + 1;
  pictures_.clear();
  const auto result = run({.formats = {"svg", "bom.csv"}, .png_scale = -1});
  ASSERT_FALSE(result.has_value());
  std::vector<std::string> fields;
  for (const Status& problem : result.error()) fields.push_back(problem.field);
  EXPECT_THAT(fields, ElementsAre("halfSide", "colors", "seed", "bom.csv", "pngScale", "drawing"));
  EXPECT_EQ(result.error().front().code, StatusCode::kInvalidParameter);
  EXPECT_EQ(result.error().back().code, StatusCode::kInvalidInput);
}

TEST_F(RunJobTest, RefusesPicturesWithoutPixels) {
  for (const ImageView& view : {ImageView{}, ImageView{drawing_.view().pixels, 0, 5, 0}}) {
    pictures_["drawing"] = view;
    EXPECT_EQ(failure().code, StatusCode::kInvalidInput);
  }
}

TEST_F(RunJobTest, TinyAndPlainPicturesNeverCrash) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {40, 1}, {2, 2}, {9, 7}}) {
    const Drawing drawing(width, height);
    pictures_["drawing"] = drawing.view();
    const auto result = run({.formats = {"svg", "dxf", "png", "json", "csv"}, .plots = true});
    EXPECT_TRUE(result || result.error().front().code == StatusCode::kInvalidInput) << width << " x " << height;
  }
}

TEST_F(RunJobTest, SaysHowFarItIs) {
  std::vector<std::string> stages;
  std::vector<double> fractions;
  RunContext context;
  context.on_stage = [&](std::string_view stage) { stages.emplace_back(stage); };
  context.on_progress = [&](double fraction) { fractions.push_back(fraction); };
  ASSERT_TRUE(run({.formats = {"svg"}}, context).has_value());
  EXPECT_GT(stages.size(), 1u);
  EXPECT_EQ(stages.back(), "format");
  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1);
}

TEST_F(RunJobTest, StopsWhenToldTo) {
  std::atomic<int> stop{static_cast<int>(StopReason::kCancelled)};
  RunContext context;
  context.stop = &stop;
  EXPECT_EQ(failure({{"svg"}}, context).code, StatusCode::kCancelled);
  stop = static_cast<int>(StopReason::kTimeout);
  EXPECT_EQ(failure({{"svg"}}, context).code, StatusCode::kTimeout);
}

TEST_F(RunJobTest, StopsBeforeWritingToo) {
  std::atomic<int> stop{static_cast<int>(StopReason::kNone)};
  RunContext context;
  context.stop = &stop;
  context.on_stage = [&](std::string_view stage) {
    if (stage == "format") stop = static_cast<int>(StopReason::kCancelled);
  };
  EXPECT_EQ(failure({{"svg"}}, context).code, StatusCode::kCancelled);
}

// Before memory is taken: behind this drawing there is one pixel.
TEST_F(RunJobTest, WhatWouldTakeAllMemoryIsRefused) {
  const std::uint8_t pixel[3] = {0, 0, 0};
  const auto problem = [&](const TechniqueParams& params, int side) {
    const auto result = run_job({1, params, {}}, {{"drawing", {pixel, side, side, 3}}}, {{"png"}, false, 1},
                                *make_cpu_rasterizer(), {});
    return result ? Status{} : result.error().front();
  };
  pavement::Params pave;
  pave.supersample = 4;
  EXPECT_EQ(problem(pave, 10000).field, "supersample");
  pave.supersample = 1;
  pave.half_side = 1;
  EXPECT_EQ(problem(pave, 10000).field, "halfSide");
  patterns::Params pattern;
  pattern.model = patterns::Model::kCheckerboard;
  pattern.size = pattern.width = pattern.height = 65536;
  const Status status = problem(pattern, 1);
  EXPECT_EQ(status.code, StatusCode::kInvalidParameter);
  EXPECT_EQ(status.field, "pngScale");
  EXPECT_THAT(status.message, HasSubstr("65536 x 65536 px"));
}

TEST_F(RunJobTest, FaultsEndAsAStatus) {
  const std::vector<std::pair<std::function<Result<void>()>, const char*>> faults = {
      {[]() -> Result<void> { throw std::bad_alloc(); }, "out of memory"},
      {[]() -> Result<void> { CV_Error(cv::Error::StsNoMem, "too much"); }, "out of memory"},
      {[]() -> Result<void> { CV_Error(cv::Error::StsAssert, "so it is"); }, "so it is"},
      {[]() -> Result<void> { return fail(StatusCode::kInternal, "", "context lost"); }, "context lost"},
  };
  for (const auto& [fault, words] : faults) {
    rasterizer_ = std::make_unique<FailingRasterizer>(fault);
    const Status status = failure();
    EXPECT_EQ(status.code, StatusCode::kInternal);
    EXPECT_THAT(status.message, HasSubstr(words));
  }
}

TEST_F(RunJobTest, SmallSheetsAreDrawnLarger) {
  const auto automatic = run({.formats = {"png"}}), fourfold = run({.formats = {"png"}, .png_scale = 4});
  ASSERT_TRUE(automatic.has_value() && fourfold.has_value());
  EXPECT_EQ(automatic->artifacts[0].bytes, fourfold->artifacts[0].bytes);
}

}  // namespace
}  // namespace tessera

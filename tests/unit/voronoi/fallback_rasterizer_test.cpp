#include "tessera/voronoi/fallback_rasterizer.h"

#include <gtest/gtest.h>

#include <string>

#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera {
namespace {

// Labels everything 0 until its calls are used up, then fails.
class FailingRasterizer : public Rasterizer {
 public:
  FailingRasterizer(int begins, int labels, StatusCode code) : begins_(begins), labels_(labels), code_(code) {}
  std::string_view name() const override { return "failing"; }
  Result<void> begin(const cv::Mat1b& zones, Metric, double) override {
    size_ = zones.size();
    return begins_-- > 0 ? Result<void>() : fail(code_, "", "no begin");
  }
  Result<void> label(const Sites&, LabelMap& labels) override {
    if (labels_-- <= 0) return fail(code_, "", "no label");
    labels = LabelMap(size_, 0);
    return {};
  }

 private:
  int begins_, labels_;
  StatusCode code_;
  cv::Size size_;
};

struct Fixture {
  Fixture(int begins, int labels, StatusCode code = StatusCode::kInternal)
      : rasterizer(make_fallback_rasterizer(std::make_unique<FailingRasterizer>(begins, labels, code),
                                            make_cpu_rasterizer(),
                                            [this](const Status& reason) { reasons.push_back(reason.message); })) {}

  Result<LabelMap> label() {
    LabelMap labels;
    return rasterizer->begin(zones, Metric::kFrustum, 100)
        .and_then([&] { return rasterizer->label(sites, labels); })
        .map([&] { return labels; });
  }

  std::vector<std::string> reasons;
  std::unique_ptr<Rasterizer> rasterizer;
  const cv::Mat1b zones = cv::Mat1b::zeros(8, 16);
  const Sites sites = {{.x = 4, .y = 4}, {.x = 12, .y = 4}};
};

TEST(FallbackRasterizer, DrawsWithTheFirstWhileThatWorks) {
  Fixture f(1, 1);
  const auto labels = f.label();
  ASSERT_TRUE(labels);
  EXPECT_EQ(cv::countNonZero(*labels), 0);
  EXPECT_EQ(f.rasterizer->name(), "failing");
  EXPECT_TRUE(f.reasons.empty());
}

TEST(FallbackRasterizer, SwitchesOnceAndSaysWhy) {
  for (const int begins : {0, 1}) {
    Fixture f(begins, 0);
    for (int run = 0; run < 2; ++run) {
      const auto labels = f.label();
      ASSERT_TRUE(labels);
      EXPECT_EQ((*labels)(0, 0), 0);
      EXPECT_EQ((*labels)(0, 15), 1);
    }
    EXPECT_EQ(f.rasterizer->name(), "cpu");
    EXPECT_EQ(f.reasons, std::vector<std::string>{begins == 0 ? "no begin" : "no label"});
  }
}

TEST(FallbackRasterizer, HandsOnErrorsThatAreNoFaultOfTheFirst) {
  Fixture f(1, 0, StatusCode::kInvalidInput);
  const auto labels = f.label();
  ASSERT_FALSE(labels);
  EXPECT_EQ(labels.error().code, StatusCode::kInvalidInput);
  EXPECT_TRUE(f.reasons.empty());
}

}  // namespace
}  // namespace tessera

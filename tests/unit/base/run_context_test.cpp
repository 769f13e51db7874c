#include "tessera/base/run_context.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace tessera {
namespace {

TEST(RunContext, AnEmptyOneLetsTheRunGoOnAndHearsNothing) {
  const RunContext context;
  EXPECT_TRUE(context.check());
  context.stage("lloyd");
  context.progress(0.5);
  context.warn("nothing to see");
}

TEST(RunContext, TheFlagEndsTheRunAtTheNextCheck) {
  std::atomic<int> stop{static_cast<int>(StopReason::kNone)};
  RunContext context;
  context.stop = &stop;
  EXPECT_TRUE(context.check());

  stop = static_cast<int>(StopReason::kCancelled);
  ASSERT_FALSE(context.check());
  EXPECT_EQ(context.check().error().code, StatusCode::kCancelled);

  stop = static_cast<int>(StopReason::kTimeout);
  ASSERT_FALSE(context.check());
  EXPECT_EQ(context.check().error().code, StatusCode::kTimeout);
  EXPECT_FALSE(context.check().error().message.empty());

  stop = static_cast<int>(StopReason::kNone);
  EXPECT_TRUE(context.check());
}

TEST(RunContext, CallbacksHearWhatIsSaid) {
  std::vector<std::string> heard;
  RunContext context;
  context.on_stage = [&](std::string_view stage) { heard.push_back("stage " + std::string(stage)); };
  context.on_progress = [&](double fraction) { heard.push_back("progress " + std::to_string(fraction)); };
  context.on_warning = [&](std::string_view message) { heard.push_back("warning " + std::string(message)); };
  context.stage("stones");
  context.progress(0.25);
  context.warn("small");
  EXPECT_EQ(heard, (std::vector<std::string>{"stage stones", "progress 0.250000", "warning small"}));
}

}  // namespace
}  // namespace tessera

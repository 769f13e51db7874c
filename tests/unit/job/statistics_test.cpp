#include "tessera/job/statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace tessera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(StatisticsTest, MeanAndVariation) {
  EXPECT_EQ(mean_of({}), 0);
  EXPECT_EQ(variation_of({}), 0);
  EXPECT_EQ(mean_of({1, 2, 6}), 3);
  EXPECT_EQ(variation_of({5, 5, 5}), 0);
  EXPECT_DOUBLE_EQ(variation_of({1, 3}), 0.5);
}

TEST(StatisticsTest, CountsWholeNumbers) {
  const Histogram histogram = count_histogram({{"a", {4, 4, 6}}, {"b", {3}}, {"none", {}}});
  EXPECT_THAT(histogram.bins, ElementsAre("3", "4", "5", "6"));
  ASSERT_EQ(histogram.series.size(), 3u);
  EXPECT_THAT(histogram.series[0].values, ElementsAre(0, 2, 0, 1));
  EXPECT_THAT(histogram.series[1].values, ElementsAre(1, 0, 0, 0));
  EXPECT_THAT(histogram.series[2].values, ElementsAre(0, 0, 0, 0));
}

TEST(StatisticsTest, CountsValuesInBins) {
  const Histogram histogram = value_histogram("a", {0, 0.9, 1, 2.5, 4}, 4);
  EXPECT_THAT(histogram.bins, ElementsAre("0.5", "1.5", "2.5", "3.5"));
  EXPECT_THAT(histogram.series[0].values, ElementsAre(2, 1, 1, 1));
}

TEST(StatisticsTest, NothingStillMakesAHistogram) {
  EXPECT_EQ(count_histogram({{"a", {}}}).bins.size(), 1u);
  const Histogram histogram = value_histogram("a", {}, 30);
  EXPECT_EQ(histogram.bins.size(), 30u);
  EXPECT_EQ(std::accumulate(histogram.series[0].values.begin(), histogram.series[0].values.end(), 0.0), 0);
  EXPECT_EQ(value_histogram("a", {0, 0}, 3).series[0].values[0], 2);
}

TEST(StatisticsTest, HalfOfAValueIsBelowItself) {
  EXPECT_THAT(cumulative({}), IsEmpty());
  EXPECT_THAT(cumulative({3}), ElementsAre(Point{3, 0}, Point{3, 50}, Point{3, 100}));
  EXPECT_THAT(cumulative({8, 2}), ElementsAre(Point{2, 0}, Point{2, 25}, Point{8, 75}, Point{8, 100}));
  EXPECT_THAT(cumulative({8, 2}, {3, 1}), ElementsAre(Point{2, 0}, Point{2, 12.5}, Point{8, 62.5}, Point{8, 100}));
}

}  // namespace
}  // namespace tessera

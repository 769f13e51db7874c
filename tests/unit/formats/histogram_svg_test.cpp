#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "tessera/formats/formats.h"

namespace tessera {
namespace {

std::vector<double> bar_heights(const std::string& svg, const std::string& fill) {
  const std::regex rect("<rect [^>]*width=\"[^\"]*\" height=\"([^\"]*)\" fill=\"" + fill + "\"/>");
  std::vector<double> heights;
  for (std::sregex_iterator at(svg.begin(), svg.end(), rect), end; at != end; ++at)
    heights.push_back(std::stod((*at)[1]));
  return heights;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(WriteHistogramSvg, BarsAreProportionalToValues) {
  const std::string svg = write_histogram_svg(
      {"Vertices", "vertices", "stones", {"3", "4", "5"}, {{"before", {10, 40, 20}}, {"after", {5, 0, 80}}}});
  const auto before = bar_heights(svg, "#2f5d8a"), after = bar_heights(svg, "#d08c3c");
  ASSERT_EQ(before.size(), 4U);  // and the legend's
  ASSERT_EQ(after.size(), 3U);   // no bar for 0
  EXPECT_NEAR(before[1] / before[0], 4, 1e-3);
  EXPECT_NEAR(before[2] / before[0], 2, 1e-3);
  EXPECT_NEAR(after[1] / before[0], 8, 1e-3);
  EXPECT_NEAR(after[0] / before[0], 0.5, 1e-3);
}

TEST(WriteHistogramSvg, TextsAreEscaped) {
  const std::string svg = write_histogram_svg({"a < b & c", "<x>", "y", {"<3"}, {{"s&t", {1}}}});
  for (const char* text : {">a &lt; b &amp; c<", ">&lt;x&gt;<", ">&lt;3<", ">s&amp;t<"})
    EXPECT_EQ(count(svg, text), 1U) << text;
}

TEST(WriteHistogramSvg, AxisHasAFewRoundTicksUpToTheHighestValue) {
  for (const double highest : {0.0, 0.01, 0.37, 1.0, 7.0, 99.0, 100.0, 12345.0, 1e9}) {
    const std::string svg = write_histogram_svg({"t", "x", "y", {"bin"}, {{"s", {highest}}}});
    const std::regex tick("text-anchor=\"end\">([^<]*)<");
    std::vector<double> ticks;
    for (std::sregex_iterator at(svg.begin(), svg.end(), tick), end; at != end; ++at)
      ticks.push_back(std::stod((*at)[1]));
    ASSERT_GE(ticks.size(), 2U);
    EXPECT_LE(ticks.size(), 7U);
    EXPECT_EQ(ticks.front(), 0);
    EXPECT_GE(ticks.back(), highest);
    EXPECT_LE(ticks[ticks.size() - 2], highest);
  }
}

TEST(WriteHistogramSvg, ManyBinsAreThinlyLabelledAndNoneIsFine) {
  Histogram histogram{"t", "x", "y", {}, {{"s", {}}}};
  EXPECT_EQ(count(write_histogram_svg(histogram), "<rect"), 2U);  // background and legend
  for (int i = 0; i < 200; ++i) {
    histogram.bins.push_back(std::string("b").append(std::to_string(i)));
    histogram.series[0].values.push_back(i);
  }
  const std::size_t labels = count(write_histogram_svg(histogram), ">b");
  EXPECT_GE(labels, 12U);
  EXPECT_LE(labels, 24U);
}

}  // namespace
}  // namespace tessera

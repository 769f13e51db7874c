#include "tessera/voronoi/cells.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "label_maps.h"

namespace tessera {
namespace {

using Rows = std::vector<std::string>;

// Labels of the pixels' own zones, label k of zone k modulo `zones`; a share of them unlabelled.
LabelMap random_labels(const cv::Mat1b& zone_map, int zones, int cells, double unlabelled, Rng& rng) {
  LabelMap labels(zone_map.size());
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int zone = zone_map(y, x), choices = (cells - zone + zones - 1) / zones;
      const bool none = choices <= 0 || rng.uniform() < unlabelled;
      labels(y, x) = none ? kUnlabelled : zone + zones * below(rng, choices);
    }
  }
  return labels;
}

void expect_connected(const LabelMap& labels, const cv::Mat1b& zones, int cells) {
  std::map<int, int> parts, zone_of;
  for (const Part& part : parts_of(labels, zones)) {
    ASSERT_GE(part.label, 0);
    ASSERT_LT(part.label, cells);
    ASSERT_EQ(++parts[part.label], 1) << "label " << part.label << " has two parts or crosses zones";
  }
}

TEST(ConnectCells, RandomMapsBecomeConnectedWithinTheirZones) {
  for (int seed = 0; seed < 150; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kSites);
    const int width = 1 + below(rng, 40), height = 1 + below(rng, 30);
    const cv::Size size(width, height);
    const int zones = 1 + seed % 4, cells = seed % 7 == 0 ? 0 : zones + below(rng, 40);
    const cv::Mat1b zone_map = random_zones(size, zones, rng);
    const LabelMap before = random_labels(zone_map, zones, cells, seed % 3 * 0.3, rng);
    LabelMap labels = before.clone();
    const int now = connect_cells(labels, zone_map, cells);
    ASSERT_GE(now, cells);
    expect_connected(labels, zone_map, now);

    // The largest part of a cell, the first among equals, keeps its label.
    std::map<int, const Part*> largest;
    const auto parts = parts_of(before, zone_map);
    for (const Part& part : parts) {
      const Part*& best = largest[part.label];
      if (!best || part.pixels.size() > best->pixels.size()) best = &part;
    }
    for (const auto& [label, part] : largest) {
      if (label == kUnlabelled) continue;
      for (const cv::Point p : part->pixels) ASSERT_EQ(labels(p), label) << "seed " << seed;
    }
    // What is connected stays as it is.
    LabelMap again = labels.clone();
    EXPECT_EQ(connect_cells(again, zone_map, now), now);
    EXPECT_TRUE(same_labels(again, labels));
  }
}

TEST(ConnectCells, APatchGoesToTheLongestBorder) {
  LabelMap labels = labels_of({"aab", "a.b", "abb"});
  EXPECT_EQ(connect_cells(labels, cv::Mat1b::zeros(3, 3), 2), 2);
  EXPECT_EQ(labels(1, 1), labels(0, 1));  // two sides each: the lower label

  labels = labels_of({"aabb", "a..b", "bbbb"});
  EXPECT_EQ(connect_cells(labels, cv::Mat1b::zeros(3, 4), 2), 2);
  EXPECT_EQ(rows_of(labels), (Rows{"aabb", "abbb", "bbbb"}));
}

TEST(ConnectCells, TheSmallerPartIsGivenAway) {
  LabelMap labels = labels_of({"aabba", "aabba", "aabbb"});
  EXPECT_EQ(connect_cells(labels, cv::Mat1b::zeros(3, 5), 2), 2);
  EXPECT_EQ(rows_of(labels), (Rows{"aabbb", "aabbb", "aabbb"}));
}

TEST(ConnectCells, PixelsThatTouchAtCornersAreApart) {
  LabelMap labels = labels_of({"ab", "ba"});
  EXPECT_EQ(connect_cells(labels, cv::Mat1b::zeros(2, 2), 2), 2);
  EXPECT_EQ(rows_of(labels)[0], "ab");
  expect_connected(labels, cv::Mat1b::zeros(2, 2), 2);
}

TEST(ConnectCells, APatchWithoutNeighboursBecomesACell) {
  cv::Mat1b zones = cv::Mat1b::zeros(3, 4);
  zones(1, 1) = zones(1, 2) = 1;
  LabelMap labels = labels_of({"aaaa", "a..a", "aaaa"});
  EXPECT_EQ(connect_cells(labels, zones, 1), 2);
  EXPECT_EQ(rows_of(labels), (Rows{"aaaa", "abba", "aaaa"}));
}

TEST(ConnectCells, ACellInTwoIslandsKeepsOneAndMakesAnother) {
  cv::Mat1b zones = cv::Mat1b::zeros(1, 5);
  zones(0, 2) = 1;
  LabelMap labels = labels_of({"aabaa"});
  EXPECT_EQ(connect_cells(labels, zones, 2), 3);
  EXPECT_EQ(rows_of(labels), (Rows{"aabcc"}));
}

TEST(ConnectCells, NothingLabelledAtAll) {
  LabelMap labels(4, 6, kUnlabelled);
  EXPECT_EQ(connect_cells(labels, cv::Mat1b::zeros(4, 6), 0), 1);
  for (const int l : labels) EXPECT_EQ(l, 0);
}

}  // namespace
}  // namespace tessera

#include "tessera/voronoi/lloyd.h"

#include <gtest/gtest.h>

#include <opencv2/core/utility.hpp>
#include <vector>

#include "label_maps.h"

namespace tessera {
namespace {

TEST(CellMoments, AgreeWithAddingPixelByPixel) {
  const int threads = cv::getNumThreads();
  Rng rng(1, RngPurpose::kSites);
  CellSums sums;  // for all of them, so that nothing is left over from the one before
  for (const cv::Size& size : {cv::Size{1, 1}, {1, 20}, {33, 1}, {64, 48}, {65, 2}, {200, 5}, {7, 3}}) {
    for (const int cells : {1, 3, 50}) {
      LabelMap labels(size);
      for (int& l : labels) l = below(rng, cells + 1) - 1;
      std::vector<CellMoments> expected(cells);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          if (labels(y, x) == kUnlabelled) continue;
          CellMoments& m = expected[labels(y, x)];
          ++m.count;
          m.sum_x += x;
          m.sum_y += y;
        }
      }
      for (const int n : {1, 2, 4}) {
        cv::setNumThreads(n);
        const auto& moments = sums.of(labels, cells);
        ASSERT_EQ(static_cast<int>(moments.size()), cells);
        for (int k = 0; k < cells; ++k) {
          ASSERT_EQ(moments[k].count, expected[k].count);
          ASSERT_EQ(moments[k].sum_x, expected[k].sum_x);
          ASSERT_EQ(moments[k].sum_y, expected[k].sum_y);
        }
      }
    }
  }
  cv::setNumThreads(threads);
}

TEST(CellMoments, CentroidIsInTheMiddleOfThePixels) {
  const auto moments = cell_moments(labels_of({"aab", "aab", "ccb"}), 4);
  EXPECT_EQ(moments[0].centroid_x(), 1);
  EXPECT_EQ(moments[0].centroid_y(), 1);
  EXPECT_EQ(moments[1].centroid_x(), 2.5);
  EXPECT_EQ(moments[1].centroid_y(), 1.5);
  EXPECT_EQ(moments[2].centroid_x(), 1);
  EXPECT_EQ(moments[2].centroid_y(), 2.5);
  EXPECT_EQ(moments[3].count, 0);
}

}  // namespace
}  // namespace tessera

#include "tessera/voronoi/preview.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

const std::vector<Rgb> kPalette = {{0, 0, 0}, {255, 255, 255}};

// Columns of two labels in zone 0, then one in zone 1; the last column has no label.
struct Stripes {
  Sites sites = {{.x = 2, .y = 4, .angle = 0.5}, {.x = 6, .y = 4}, {.x = 10, .y = 4, .zone = 1}};
  LabelMap labels{8, 13};
  Stripes() {
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x) labels(y, x) = x < 12 ? x / 4 : kUnlabelled;
  }
  Iteration iteration(double scale = 1) const { return {0, 0, scale, sites, labels, kPalette}; }
};

TEST(Preview, MarksZonesAndBorders) {
  const Stripes stripes;
  const cv::Mat1b cells = make_preview(stripes.iteration(), 1000, 10).cells;
  ASSERT_EQ(cells.size(), stripes.labels.size());
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x) {
      const int zone = x >= 8 && x < 12 ? 1 : 0;
      const int border = x == 3              ? kPreviewCellBorder
                         : x == 7 || x == 11 ? kPreviewCellBorder | kPreviewZoneBorder
                                             : 0;
      EXPECT_EQ(cells(y, x), zone | border) << x;
    }
  }
}

TEST(Preview, KeepsToItsLimits) {
  const Stripes stripes;
  for (int limit = 1; limit <= 104; ++limit) {
    const Preview preview = make_preview(stripes.iteration(), limit, 1 + limit % 3);
    EXPECT_LE(preview.cells.total(), static_cast<std::size_t>(limit));
    EXPECT_GE(preview.cells.total(), 1u);
    EXPECT_LE(preview.sites.size(), 4u * (1 + limit % 3));
  }
}

TEST(Preview, GivesSitesInSourcePixels) {
  const Stripes stripes;
  EXPECT_EQ(make_preview(stripes.iteration(2), 10, 10).sites,
            (std::vector<float>{1, 2, 0.5, 0, 3, 2, 0, 0, 5, 2, 0, 1}));
  EXPECT_EQ(make_preview(stripes.iteration(2), 10, 2).sites, (std::vector<float>{1, 2, 0.5, 0, 5, 2, 0, 1}));
}

}  // namespace
}  // namespace tessera

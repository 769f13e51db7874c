#include "tessera/voronoi/lloyd.h"

#include <algorithm>
#include <cstring>
#include <opencv2/core/utility.hpp>

namespace tessera {
namespace {

// First column from x on whose label differs from that at x. Pairs of labels are compared at a time.
int end_of_run(const std::int32_t* row, int x, int columns) {
  const std::int32_t label = row[x];
  std::uint64_t pair, expected = static_cast<std::uint32_t>(label);
  expected |= expected << 32;
  for (++x; x + 1 < columns; x += 2) {
    std::memcpy(&pair, row + x, sizeof pair);
    if (pair != expected) return row[x] == label ? x + 1 : x;
  }
  while (x < columns && row[x] == label) ++x;
  return x;
}

// Adds runs of equal labels, not pixels: a run from a to b of row y has its sums in closed form.
void add_rows(const LabelMap& labels, const cv::Range& rows, std::vector<CellMoments>& moments) {
  for (int y = rows.start; y < rows.end; ++y) {
    const std::int32_t* row = labels[y];
    for (int x = 0; x < labels.cols;) {
      const std::int32_t label = row[x];
      const int begin = x;
      x = end_of_run(row, x, labels.cols);
      if (label < 0) continue;
      CellMoments& m = moments[label];
      const std::int64_t n = x - begin;
      m.count += n;
      m.sum_x += n * (begin + x - 1) / 2;
      m.sum_y += n * y;
    }
  }
}

}  // namespace

std::vector<CellMoments> cell_moments(const LabelMap& labels, int cells) {
  const int stripes = std::clamp(cv::getNumThreads(), 1, 8);
  std::vector<std::vector<CellMoments>> partial(stripes, std::vector<CellMoments>(cells));
  cv::parallel_for_({0, stripes}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      add_rows(labels, {labels.rows * i / stripes, labels.rows * (i + 1) / stripes}, partial[i]);
  });
  for (int i = 1; i < stripes; ++i) {
    for (int k = 0; k < cells; ++k) {
      partial[0][k].count += partial[i][k].count;
      partial[0][k].sum_x += partial[i][k].sum_x;
      partial[0][k].sum_y += partial[i][k].sum_y;
    }
  }
  return std::move(partial[0]);
}

}  // namespace tessera

#include "tessera/pebbles/neighbours.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tessera::pebbles {

int largest_label(const cv::Mat1i& labels) {
  return labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end());
}

void keep_largest_parts(cv::Mat1i& labels, int count) {
  cv::Mat1i part(labels.size(), 0);  // from 1
  std::vector<int> largest(count + 1, 0), size(count + 1, 0);
  std::vector<std::pair<int, int>> open;
  int parts = 0;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels(y, x);
      if (label == 0 || part(y, x) != 0) continue;
      part(y, x) = ++parts;
      open = {{y, x}};
      int pixels = 0;
      for (; !open.empty(); ++pixels) {
        const auto [v, u] = open.back();
        open.pop_back();
        each_neighbour(labels, v, u, [&](int b, int a) {
          if (labels(b, a) != label || part(b, a) != 0) return;
          part(b, a) = parts;
          open.emplace_back(b, a);
        });
      }
      if (pixels > size[label]) size[label] = pixels, largest[label] = parts;
    }
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (labels(y, x) != 0 && part(y, x) != largest[labels(y, x)]) labels(y, x) = 0;
}

}  // namespace tessera::pebbles

// Label maps and canvases for the tests of diagrams.
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/rng.h"
#include "tessera/voronoi/rasterizer.h"

namespace tessera {

inline int below(Rng& rng, int end) { return static_cast<int>(rng.bits() % static_cast<unsigned>(end)); }

inline bool same_labels(const LabelMap& a, const LabelMap& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

// Zones in blocks of a few pixels, so that their borders are everywhere.
inline cv::Mat1b random_zones(const cv::Size& size, int zones, Rng& rng) {
  const int block_x = 1 + below(rng, 20), block_y = 1 + below(rng, 20);
  cv::Mat1b map(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      map(y, x) = static_cast<unsigned char>((x / block_x + 3 * (y / block_y)) % zones);
  return map;
}

// 'a' is label 0; a full stop is kUnlabelled.
inline LabelMap labels_of(const std::vector<std::string>& rows) {
  LabelMap labels(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) labels(y, x) = rows[y][x] == '.' ? kUnlabelled : rows[y][x] - 'a';
  return labels;
}

inline std::vector<std::string> rows_of(const LabelMap& labels) {
  std::vector<std::string> rows;
  for (int y = 0; y < labels.rows; ++y) {
    rows.emplace_back();
    for (int x = 0; x < labels.cols; ++x) rows[y] += static_cast<char>(labels(y, x) < 0 ? '.' : 'a' + labels(y, x));
  }
  return rows;
}

// A part of a label map: connected pixels of one label and zone.
struct Part {
  int label;
  std::vector<cv::Point> pixels;
};

// In reading order of their first pixels; 4-connected.
inline std::vector<Part> parts_of(const LabelMap& labels, const cv::Mat1b& zones) {
  std::vector<Part> parts;
  cv::Mat1b seen(labels.size(), static_cast<unsigned char>(0));
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      if (seen(y, x)) continue;
      seen(y, x) = 1;
      Part part{labels(y, x), {{x, y}}};
      for (std::size_t i = 0; i < part.pixels.size(); ++i) {
        for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          const cv::Point q = part.pixels[i] + cv::Point(dx, dy);
          if (q.x < 0 || q.y < 0 || q.x >= labels.cols || q.y >= labels.rows || seen(q)) continue;
          if (labels(q) != labels(y, x) || zones(q) != zones(y, x)) continue;
          seen(q) = 1;
          part.pixels.push_back(q);
        }
      }
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

}  // namespace tessera

// Straight ways through a mask, up to the first pixel that is not free.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace tessera::pebbles {

inline constexpr int kRays = 90;

// A pixel of what is not free stops the rays; so does the picture's border. Whole numbers: the same on every
// platform.
class Mask {
 public:
  // `edges`: not 0 where a pixel is not free.
  explicit Mask(const cv::Mat1b& edges);

  bool free(cv::Point p) const { return distance(p) > 0; }
  bool inside(cv::Point p) const { return p.x >= 0 && p.y >= 0 && p.x < width_ && p.y < height_; }

  // City-block distance to the next pixel that is not free, those around the picture among them; `p` at most one
  // pixel outside of it.
  int distance(cv::Point p) const { return distance_(p.y + 1, p.x + 1); }

  // The first pixel that is not free from the centre of `from` in each direction, 2 pi k / kRays from x towards y;
  // one just outside of the picture where there is none. 4-connected ways: no 8-connected edge lets them through.
  std::array<cv::Point, kRays> hits(cv::Point from) const;

  // These are not free any more.
  void fill(const std::vector<cv::Point>& pixels);

 private:
  int width_, height_;
  cv::Mat1i distance_;  // with a border of 1 px
};

}  // namespace tessera::pebbles

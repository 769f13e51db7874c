// Panels, turned (3.2, Eq. 3).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/point.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"
#include "tessera/parquetry/rows.h"

namespace tessera::parquetry {

// A picture turned clockwise about its middle, into the least frame of whole pixels around it. A middle of a pixel is
// taken to that of another where the turn is a multiple of a right angle and the sides allow it.
class Turn {
 public:
  Turn(cv::Size picture, double degrees);

  double degrees() const { return degrees_; }
  cv::Size size() const { return size_; }  // of the frame
  Point to_picture(Point frame) const;
  // The pixels of each row of the frame whose middles lie in the picture; together they are convex.
  std::vector<Span> spans() const;
  // The picture in the frame, 8 bits and up to 4 channels, bilinear between pixel centres; rows as in spans().
  // Whole numbers only: the same on every platform.
  Rows turned(const cv::Mat& picture, int around) const;

 private:
  std::int64_t x_at(int x, int y) const { return x0_ + cosine_ * x + sine_ * y; }
  std::int64_t y_at(int x, int y) const { return y0_ - sine_ * x + cosine_ * y; }

  cv::Size picture_, size_;
  double degrees_, cos_, sin_;
  std::int64_t cosine_, sine_, x0_, y0_;  // of 2^32 parts of a pixel; (x0_, y0_): the middle of pixel (0, 0)
};

// Rotations j of `rotations` over a full turn that `grain` allows: all; 0 and 180 degrees (aligned); up to
// grainDegrees off these (degrees). At least rotation 0.
std::vector<int> allowed_rotations(const Params& params);
double degrees_of(int rotation, const Params& params);

// Where a box of `size` lies with its top left pixel at `at` of a turned panel, as a placement without its patch,
// panel and cost; `middle`: of the box on the target.
Placement place(const Turn& turn, int rotation, cv::Size size, cv::Point at, Point middle);

}  // namespace tessera::parquetry

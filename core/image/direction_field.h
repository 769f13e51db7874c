// Angles that vary smoothly over a picture and count modulo a right angle, as a square's do.
#pragma once

#include <opencv2/core.hpp>

namespace tessera {

// Nodes `step` pixels apart, the first at (0, 0); each holds (cos, sin) of four times the angle, of any length.
class DirectionField {
 public:
  DirectionField() = default;
  // Covers a picture of this size; all nodes (0, 0).
  DirectionField(cv::Size picture, double step);

  // In (-pi/4, pi/4], from x towards y; bilinear between nodes.
  double angle(double x, double y) const;

  double step() const { return step_; }
  cv::Mat2f& nodes() { return nodes_; }
  const cv::Mat2f& nodes() const { return nodes_; }

 private:
  double step_ = 1;
  cv::Mat2f nodes_;
};

}  // namespace tessera

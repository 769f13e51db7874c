#include "tessera/image/direction_field.h"

#include <algorithm>

#include "tessera/base/portable_math.h"

namespace tessera {

DirectionField::DirectionField(cv::Size picture, double step)
    : step_(step),
      nodes_(static_cast<int>(picture.height / step) + 2, static_cast<int>(picture.width / step) + 2,
             cv::Vec2f(0, 0)) {}

double DirectionField::angle(double x, double y) const {
  const double u = std::clamp(x / step_, 0.0, nodes_.cols - 1.001),
               v = std::clamp(y / step_, 0.0, nodes_.rows - 1.001);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const float s = static_cast<float>(u - i), t = static_cast<float>(v - j);
  const cv::Vec2f a = nodes_(j, i) * (1 - s) + nodes_(j, i + 1) * s,
                  b = nodes_(j + 1, i) * (1 - s) + nodes_(j + 1, i + 1) * s;
  const cv::Vec2f n = a * (1 - t) + b * t;
  return atan2_portable(n[1], n[0]) / 4;
}

}  // namespace tessera

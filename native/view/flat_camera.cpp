#include "tessera/view/flat_camera.h"

#include <algorithm>
#include <cmath>

namespace tessera::view {

double FlatCamera::fitting_scale() const {
  return std::min(window_.width / content_.width, window_.height / content_.height);
}

void FlatCamera::fit() {
  scale_ = fitting_scale();
  corner_ = {(window_.width - scale_ * content_.width) / 2, (window_.height - scale_ * content_.height) / 2};
  fits_ = true;
}

void FlatCamera::zoom_at(Point at, double factor) {
  const double fitting = fitting_scale();
  const double scale = std::clamp(scale_ * factor, std::min(fitting, 1.0) / 4, std::max(16 * fitting, 64.0));
  corner_ = at - scale / scale_ * (at - corner_);
  scale_ = scale;
  fits_ = false;
  limit();
}

void FlatCamera::pan(Point by) {
  corner_ += by;
  fits_ = false;
  limit();
}

void FlatCamera::resize(Size window) {
  const Point moved{(window.width - window_.width) / 2, (window.height - window_.height) / 2};
  window_ = window;
  if (fits_) return fit();
  corner_ += moved;
  limit();
}

Point FlatCamera::corner() const { return {std::round(corner_.x), std::round(corner_.y)}; }

void FlatCamera::limit() {
  const double middle_x = window_.width / 2, middle_y = window_.height / 2;
  corner_.x = std::clamp(corner_.x, middle_x - scale_ * content_.width, middle_x);
  corner_.y = std::clamp(corner_.y, middle_y - scale_ * content_.height, middle_y);
}

}  // namespace tessera::view

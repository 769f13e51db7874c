#include "tessera/view/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace tessera::view {
namespace {

constexpr double kHalfField = 0.35;  // half the angle of view from bottom to top
constexpr double kFirstUp = 1.05;
constexpr double kLowest = 0.02, kHighest = 1.55;  // looking straight down, up would have no direction

}  // namespace

void OrbitCamera::reset() {
  around_ = 0;
  up_ = kFirstUp;
  fit();
}

OrbitCamera::Axes OrbitCamera::axes() const {
  const glm::dvec3 back{std::cos(up_) * std::sin(around_), std::sin(up_), std::cos(up_) * std::cos(around_)};
  const glm::dvec3 right{std::cos(around_), 0, -std::sin(around_)};
  return {right, glm::cross(back, right), back};
}

double OrbitCamera::radius() const { return std::max(glm::length(bounds_.most - bounds_.least) / 2, 1e-6); }

// A corner at (x, y, z) of the camera's axes, from the box's middle, is within the view of a camera that is moved up
// by s and at distance d where |y - s| <= (d - z) t, t the tangent of half the field. The least d for all corners has
// d t = (a + b) / 2 and s = (a - b) / 2 with a = max(y + t z) and b = max(t z - y); across the same.
void OrbitCamera::fit() {
  const glm::dvec3 middle = (bounds_.least + bounds_.most) / 2.0;
  const Axes axes = this->axes();
  const glm::dvec2 tangents{std::tan(kHalfField) * aspect_, std::tan(kHalfField)};
  glm::dvec2 a(-std::numeric_limits<double>::infinity()), b = a;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p =
        glm::dvec3{corner & 1 ? bounds_.most.x : bounds_.least.x, corner & 2 ? bounds_.most.y : bounds_.least.y,
                   corner & 4 ? bounds_.most.z : bounds_.least.z} -
        middle;
    const glm::dvec2 across{glm::dot(p, axes.right), glm::dot(p, axes.up)};
    a = glm::max(a, tangents * glm::dot(p, axes.back) + across);
    b = glm::max(b, tangents * glm::dot(p, axes.back) - across);
  }
  const glm::dvec2 distances = (a + b) / 2.0 / tangents, shift = (a - b) / 2.0;
  distance_ = std::max({distances.x, distances.y, 0.01 * radius()});
  target_ = middle + shift.x * axes.right + shift.y * axes.up;
  // The same eye looks at what is in the view's middle at the box's middle height, which it is turned around.
  const double nearer = (middle.y - target_.y) / axes.back.y;
  target_ += nearer * axes.back;
  distance_ -= nearer;
  fits_ = true;
}

void OrbitCamera::turn(double around, double up) {
  around_ = std::remainder(around_ + around, 2 * M_PI);
  up_ = std::clamp(up_ + up, kLowest, kHighest);
  fits_ = false;
}

void OrbitCamera::zoom(double factor) {
  distance_ = std::clamp(distance_ / factor, 0.01 * radius(), 20 * radius());
  fits_ = false;
}

void OrbitCamera::pan(glm::dvec2 by) {
  const Axes a = axes();
  const double height = 2 * distance_ * std::tan(kHalfField);
  target_ -= by.x * height * a.right - by.y * height * a.up;
  target_ = glm::clamp(target_, bounds_.least, bounds_.most);
  fits_ = false;
}

void OrbitCamera::resize(double aspect) {
  aspect_ = aspect;
  if (fits_) fit();
}

glm::dvec3 OrbitCamera::eye() const { return target_ + distance_ * axes().back; }

glm::dmat4 OrbitCamera::view_projection() const {
  const glm::dvec3 middle = (bounds_.least + bounds_.most) / 2.0;
  const double far = glm::length(eye() - middle) + radius(), near = std::max(far - 4 * radius(), far / 2000);
  return glm::perspective(2 * kHalfField, aspect_, near, far) * glm::lookAt(eye(), target_, axes().up);
}

}  // namespace tessera::view

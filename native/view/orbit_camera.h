// A camera that goes around a thing and looks at it.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera::view {

// An upright box, least <= most in each coordinate.
struct Bounds {
  glm::dvec3 least{0}, most{0};
};

// World coordinates as in Scene: y up, right-handed. Angles in radians.
class OrbitCamera {
 public:
  OrbitCamera() = default;
  // `aspect` is the window's width over its height.
  OrbitCamera(const Bounds& bounds, double aspect) : bounds_(bounds), aspect_(aspect) { reset(); }

  // From the front (+z) and above, as near as all of the box is seen; it stays so when the window changes its size.
  void reset();
  // Around the vertical axis, and up; never below the ground nor over the top.
  void turn(double around, double up);
  // Nearer by `factor` (> 0).
  void zoom(double factor);
  // Moves what is looked at by parts of the window's height, x right and y down.
  void pan(glm::dvec2 by);
  void resize(double aspect);

  glm::dvec3 eye() const;
  glm::dvec3 target() const { return target_; }
  glm::dmat4 view_projection() const;  // to OpenGL's clip coordinates

 private:
  // The camera's axes in the world: right, up, and towards the eye.
  struct Axes {
    glm::dvec3 right, up, back;
  };
  Axes axes() const;
  double radius() const;  // of the box's sphere, above 0
  void fit();

  Bounds bounds_;
  double aspect_ = 1;
  double around_ = 0, up_ = 0, distance_ = 1;
  glm::dvec3 target_{0};
  bool fits_ = true;
};

}  // namespace tessera::view

#include "tessera/view/orbit_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <random>

namespace tessera::view {
namespace {

const Bounds kField{{-2, 0, -1}, {2, 0.3, 1}};

glm::dvec3 on_screen(const OrbitCamera& camera, glm::dvec3 world) {
  const glm::dvec4 clip = camera.view_projection() * glm::dvec4(world, 1);
  return glm::dvec3(clip) / clip.w;
}

glm::dvec3 corner(const Bounds& b, int k) {
  return {k & 1 ? b.most.x : b.least.x, k & 2 ? b.most.y : b.least.y, k & 4 ? b.most.z : b.least.z};
}

TEST(OrbitCamera, all_of_the_box_is_seen_and_fills_the_window) {
  std::mt19937 random(3);
  const auto number = [&] { return 0.01 + 5 * (random() / 4294967296.0); };
  for (int seed = 0; seed < 200; ++seed) {
    const glm::dvec3 least{-number(), -number(), -number()};
    const Bounds box{least, least + glm::dvec3{number(), number(), number()}};
    const OrbitCamera camera(box, 0.3 + number() / 2);
    double most = 0;
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 p = on_screen(camera, corner(box, k));
      ASSERT_LE(std::fabs(p.z), 1 + 1e-9);  // between the near and the far plane
      most = std::max({most, std::fabs(p.x), std::fabs(p.y)});
    }
    ASSERT_NEAR(most, 1, 1e-9);
  }
}

TEST(OrbitCamera, first_from_the_front_and_above) {
  const OrbitCamera camera(kField, 1.5);
  EXPECT_NEAR(camera.eye().x, 0, 1e-12);
  EXPECT_GT(camera.eye().y, 1);
  EXPECT_GT(camera.eye().z, 1);
  EXPECT_GT(on_screen(camera, {1, 0, 0}).x, 0);                                // x to the right
  EXPECT_LT(on_screen(camera, {0, 0, 1}).y, on_screen(camera, {0, 0, -1}).y);  // z, the picture's y, down
}

TEST(OrbitCamera, turning_keeps_the_target_in_the_middle_and_the_distance) {
  OrbitCamera camera(kField, 1.5);
  const double distance = glm::length(camera.eye() - camera.target());
  for (int step = 0; step < 40; ++step) {
    camera.turn(0.37, step % 2 ? 0.4 : -0.7);
    EXPECT_NEAR(glm::length(camera.eye() - camera.target()), distance, 1e-9);
    const glm::dvec3 middle = on_screen(camera, camera.target());
    EXPECT_NEAR(middle.x, 0, 1e-9);
    EXPECT_NEAR(middle.y, 0, 1e-9);
    EXPECT_GT(camera.eye().y, camera.target().y);  // never below
  }
  camera.reset();
  EXPECT_NEAR(glm::length(camera.eye() - camera.target()), distance, 1e-9);
}

TEST(OrbitCamera, zooming_comes_nearer) {
  OrbitCamera camera(kField, 1.5);
  const double distance = glm::length(camera.eye() - camera.target());
  camera.zoom(2);
  EXPECT_NEAR(glm::length(camera.eye() - camera.target()), distance / 2, 1e-9);
  for (int step = 0; step < 100; ++step) camera.zoom(3);
  EXPECT_GT(glm::length(camera.eye() - camera.target()), 0);
  for (int step = 0; step < 100; ++step) camera.zoom(0.1);
  EXPECT_LT(glm::length(camera.eye() - camera.target()), 100);
}

TEST(OrbitCamera, panning_moves_what_is_in_the_middle_by_as_much) {
  OrbitCamera camera(kField, 1.5);
  camera.zoom(4);
  const glm::dvec3 before = camera.target();
  camera.pan({0.1, 0});  // of the window's height, which is two in these coordinates
  EXPECT_NEAR(on_screen(camera, before).x, 0.2 / 1.5, 1e-9);
  EXPECT_NEAR(on_screen(camera, before).y, 0, 1e-9);
  for (int step = 0; step < 50; ++step) camera.pan({1, 1});
  EXPECT_EQ(camera.target(), glm::clamp(camera.target(), kField.least, kField.most));
}

TEST(OrbitCamera, a_thing_without_size_is_seen_too) {
  const OrbitCamera camera({{1, 2, 3}, {1, 2, 3}}, 1);
  const glm::dvec3 p = on_screen(camera, {1, 2, 3});
  EXPECT_NEAR(p.x, 0, 1e-6);
  EXPECT_NEAR(p.y, 0, 1e-6);
  EXPECT_LE(std::fabs(p.z), 1);
}

}  // namespace
}  // namespace tessera::view

#include "tessera/view/flat_camera.h"

#include <gtest/gtest.h>

#include <random>

namespace tessera::view {
namespace {

void expect_near(Point a, Point b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

TEST(FlatCamera, fits_the_whole_in_the_middle) {
  const FlatCamera wide({200, 100}, {800, 600});
  EXPECT_DOUBLE_EQ(wide.scale(), 4);
  expect_near(wide.to_window({0, 0}), {0, 100}, 0);
  expect_near(wide.to_window({200, 100}), {800, 500}, 0);
  const FlatCamera tall({100, 200}, {800, 600});
  EXPECT_DOUBLE_EQ(tall.scale(), 3);
  expect_near(tall.to_window({100, 200}), {550, 600}, 0);
}

TEST(FlatCamera, what_is_under_the_cursor_stays_there) {
  FlatCamera camera({300, 200}, {900, 600});
  const Point cursor{333, 222};
  const Point under = camera.to_content(cursor);
  for (const double factor : {2.0, 1.3, 1.7, 0.5}) {
    camera.zoom_at(cursor, factor);
    expect_near(camera.to_content(cursor), under, 1e-9);
    expect_near(camera.to_window(under), cursor, 0.5);  // corners are whole pixels
  }
  EXPECT_NEAR(camera.scale(), 3 * 2 * 1.3 * 1.7 * 0.5, 1e-9);
}

TEST(FlatCamera, zooming_ends_somewhere) {
  FlatCamera camera({300, 200}, {900, 600});
  camera.zoom_at({450, 300}, 1e9);
  EXPECT_DOUBLE_EQ(camera.scale(), 64);
  camera.zoom_at({450, 300}, 1e-9);
  EXPECT_DOUBLE_EQ(camera.scale(), 0.25);
  camera.fit();
  EXPECT_DOUBLE_EQ(camera.scale(), 3);
}

TEST(FlatCamera, the_middle_never_leaves_the_content) {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  for (int seed = 0; seed < 100; ++seed) {
    FlatCamera camera({number(1, 5000), number(1, 5000)}, {number(100, 2000), number(100, 2000)});
    for (int step = 0; step < 30; ++step) {
      camera.zoom_at({number(-100, 2100), number(-100, 2100)}, number(0.2, 4));
      camera.pan({number(-3000, 3000), number(-3000, 3000)});
      if (step % 7 == 0) camera.resize({number(100, 2000), number(100, 2000)});
      const Point middle = camera.to_content({camera.window().width / 2, camera.window().height / 2});
      ASSERT_GE(middle.x, -1e-6);
      ASSERT_GE(middle.y, -1e-6);
      ASSERT_LE(middle.x, camera.content().width + 1e-6);
      ASSERT_LE(middle.y, camera.content().height + 1e-6);
    }
  }
}

TEST(FlatCamera, dragging_moves_by_as_much) {
  FlatCamera camera({300, 200}, {900, 600});
  const Point before = camera.to_window({150, 100});
  camera.pan({40, -25});
  expect_near(camera.to_window({150, 100}), before + Point{40, -25}, 0);
}

TEST(FlatCamera, another_window_keeps_what_is_seen) {
  FlatCamera fitted({300, 200}, {900, 600});
  fitted.resize({450, 600});
  EXPECT_DOUBLE_EQ(fitted.scale(), 1.5);
  FlatCamera zoomed({300, 200}, {900, 600});
  zoomed.zoom_at({450, 300}, 2);
  zoomed.pan({30, 10});
  const Point middle = zoomed.to_content({450, 300});
  zoomed.resize({500, 700});
  EXPECT_DOUBLE_EQ(zoomed.scale(), 6);
  expect_near(zoomed.to_content({250, 350}), middle, 1e-9);
}

}  // namespace
}  // namespace tessera::view

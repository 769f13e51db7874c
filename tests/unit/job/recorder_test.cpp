// Frames of iterations.
#include "tessera/job/recorder.h"

#include <gtest/gtest.h>

#include "../formats/animation.h"
#include "../image_views.h"
#include "tessera/job/job.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera {
namespace {

// Left half red, right half blue.
cv::Mat3b two_halves(int width, int height) {
  cv::Mat3b picture(height, width, cv::Vec3b(200, 0, 0));
  picture(cv::Rect(width / 2, 0, width - width / 2, height)).setTo(cv::Vec3b(0, 0, 160));
  return picture;
}

TEST(Recorder, CellsHaveThePicturesColoursAndDarkBorders) {
  const cv::Mat3b picture = two_halves(8, 2);
  LabelMap labels(4, 16, 0);  // twice the picture's size
  labels(cv::Rect(8, 0, 8, 4)).setTo(1);
  Recorder recorder(view_of(picture));
  recorder.record({0, 0, 2, Sites(2), labels, {}});
  ASSERT_EQ(recorder.frames(), 1);
  const Raster frame = recorder.frame(0);
  ASSERT_EQ(frame.width, 8);
  ASSERT_EQ(frame.height, 2);
  const std::vector<int> reds = {200, 200, 200, 125, 0, 0, 0, 0};
  for (int x = 0; x < 8; ++x) EXPECT_EQ(frame.bytes[3 * x], reds[x]) << x;
  EXPECT_EQ(frame.bytes[3 * 7 + 2], 160);
}

TEST(Recorder, ManyIterationsAreThinnedOut) {
  const cv::Mat3b picture = two_halves(3, 3);
  const LabelMap labels(3, 3, kUnlabelled);
  for (const int last : {0, 1, 20, 58, 59, 60, 117, 118, 1000}) {
    Recorder recorder(view_of(picture));
    for (int i = 0; i <= last; ++i) recorder.record({i, last, 1, {}, labels, {}});
    EXPECT_LE(recorder.frames(), 60) << last;
    EXPECT_GE(recorder.frames(), last < 60 ? last + 1 : 30) << last;
  }
}

TEST(Recorder, LargeFramesAreFewer) {
  const cv::Mat3b picture = two_halves(800, 800);
  const LabelMap labels(800, 800, 0);
  Recorder recorder(view_of(picture));
  for (int i = 0; i <= 40; ++i) recorder.record({i, 40, 1, Sites(1), labels, {}});
  EXPECT_LE(recorder.frames() * 800 * 800 * 4, 54'000'000);
  EXPECT_GE(recorder.frames(), 12);
}

TEST(Recorder, AnyIterationIsDrawnAsAFrame) {
  const cv::Mat3b picture = two_halves(80, 80);
  LabelMap labels(80, 80, 0);
  labels.rowRange(40, 80) = 1;
  Recorder recorder(view_of(picture));
  recorder.record({0, 100000, 1, Sites(2), labels, {}});
  EXPECT_EQ(Recorder::draw(view_of(picture), {7, 100000, 1, Sites(2), labels, {}}).bytes, recorder.frame(0).bytes);
}

TEST(Recorder, LargePicturesMakeSmallFrames) {
  const cv::Mat3b picture = two_halves(2000, 500);
  const LabelMap labels(500, 2000, 0);
  Recorder recorder(view_of(picture));
  recorder.record({0, 0, 1, Sites(1), labels, {}});
  EXPECT_EQ(recorder.frame(0).width, 800);
  EXPECT_EQ(recorder.frame(0).height, 200);
}

TEST(Recorder, EveryTechniqueIsAnimated) {
  const cv::Mat3b picture = two_halves(90, 60);
  const auto rasterizer = make_cpu_rasterizer();
  pavement::Params stones;
  stones.iterations = 3;
  mosaic::Params tiles;
  tiles.tiles = 40;
  tiles.iterations = 3;
  const Job pavement{.seed = 1, .params = stones, .inputs = {}}, mosaic{.seed = 1, .params = tiles, .inputs = {}};
  for (const auto& [job, role] : {std::pair{pavement, "drawing"}, {mosaic, "photo"}}) {
    int watched = 0;
    const auto result = run_job(job, {{role, view_of(picture)}}, {.formats = {"apng"}}, *rasterizer, {},
                                [&](const Iteration&) { ++watched; });
    ASSERT_TRUE(result) << role;
    EXPECT_EQ(watched, 4) << role;
    EXPECT_EQ(read_animation(result->artifacts[0].bytes).frames.size(), 5u) << role;
    EXPECT_EQ(result->artifacts[0].media_type, "image/apng");
  }
}

}  // namespace
}  // namespace tessera

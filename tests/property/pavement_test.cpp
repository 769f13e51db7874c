// What must hold of every pavement, whatever the drawing, the seed and the parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <opencv2/core/utility.hpp>
#include <set>
#include <string>
#include <vector>

#include "../unit/pavement/drawings.h"
#include "tessera/geometry/polygon.h"
#include "tessera/pavement/fields.h"
#include "tessera/pavement/run.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::pavement {
namespace {

Output pave(const cv::Mat3b& picture, const Params& params, std::uint64_t seed) {
  const auto rasterizer = make_cpu_rasterizer();
  return run(view_of(picture), params, seed, *rasterizer, {}).value();
}

struct Paved {
  const NamedDrawing* drawing;
  std::uint64_t seed;
  Params params;
  Output output;

  std::string name() const { return drawing->name + ", seed " + std::to_string(seed); }
};

constexpr int kSeeds = 30;

// Each drawing paved with many seeds and varied parameters; made once for all tests.
const std::vector<Paved>& all_results() {
  static const std::vector<NamedDrawing> drawings = all_drawings();
  static const std::vector<Paved> results = [] {
    std::vector<Paved> list;
    for (const NamedDrawing& drawing : drawings) {
      for (int seed = 0; seed < kSeeds; ++seed) {
        Params params;
        params.colors = drawing.colors;
        params.iterations = seed % 3 == 0 ? 20 : 4;
        params.grout = seed % 2 == 0 ? 0 : 0.5;
        if (seed % 5 == 4) params.half_side = 2.5;
        if (seed % 7 == 6) params.distance = Distance::kChamfer;
        list.push_back({&drawing, static_cast<std::uint64_t>(seed), params, pave(drawing.picture, params, seed)});
      }
    }
    return list;
  }();
  return results;
}

const Ring& ring_of(const Piece& stone) { return stone.outline.outer; }

// The stones of all results of which something holds, counted by drawing, with the first of each.
template <class Is>
std::string stones_that(const Is& is) {
  std::map<std::string, std::pair<int, std::string>> found;
  for (const Paved& result : all_results()) {
    for (const Piece& stone : result.output.sheet.pieces) {
      if (!is(stone, result)) continue;
      auto& [count, first] = found[result.drawing->name];
      if (count++ == 0) first = "seed " + std::to_string(result.seed) + ", stone " + std::to_string(stone.id);
    }
  }
  std::string text;
  for (const auto& [name, entry] : found)
    text += name + ": " + std::to_string(entry.first) + ", the first in " + entry.second + "\n";
  return text;
}

bool leaves_the_picture(const Piece& stone, const Paved& result) {
  const double width = result.drawing->picture.cols, height = result.drawing->picture.rows;
  const auto is_within = [&](Point p) {  // false for NaN
    return p.x >= -1e-9 && p.y >= -1e-9 && p.x <= width + 1e-9 && p.y <= height + 1e-9;
  };
  return !std::all_of(ring_of(stone).begin(), ring_of(stone).end(), is_within);
}

bool has_too_few_vertices(const Piece& stone, const Paved&) {
  std::set<std::pair<double, double>> distinct;
  for (const Point p : ring_of(stone)) distinct.insert({p.x, p.y});
  return distinct.size() < 4;
}

bool crosses_itself(const Piece& stone, const Paved&) { return !is_simple(ring_of(stone)); }

bool is_turned_over(const Piece& stone, const Paved&) { return !(signed_area(ring_of(stone)) > 0); }

TEST(Pavement, VerticesAreFiniteAndInThePicture) { EXPECT_EQ(stones_that(leaves_the_picture), ""); }

TEST(Pavement, StonesHaveFourDistinctVertices) { EXPECT_EQ(stones_that(has_too_few_vertices), ""); }

TEST(Pavement, OutlinesAreSimple) { EXPECT_EQ(stones_that(crosses_itself), ""); }

TEST(Pavement, AreasArePositive) { EXPECT_EQ(stones_that(is_turned_over), ""); }

TEST(Pavement, IdsCountFromOneAndMeasuresFitTheStones) {
  for (const Paved& result : all_results()) {
    const Output& output = result.output;
    ASSERT_GE(output.sheet.pieces.size(), 1u) << result.name();
    ASSERT_EQ(output.vertices_before.size(), output.sheet.pieces.size());
    ASSERT_EQ(output.vertices_after.size(), output.sheet.pieces.size());
    ASSERT_EQ(output.areas.size(), output.sheet.pieces.size());
    for (std::size_t i = 0; i < output.sheet.pieces.size(); ++i) {
      const Piece& stone = output.sheet.pieces[i];
      ASSERT_EQ(stone.id, static_cast<int>(i) + 1);
      ASSERT_TRUE(stone.outline.holes.empty());
      ASSERT_EQ(output.vertices_after[i], static_cast<int>(ring_of(stone).size()));
      ASSERT_NEAR(output.areas[i], area(stone.outline), 1e-9);
    }
    EXPECT_EQ(output.sheet.width, result.drawing->picture.cols);
    EXPECT_EQ(output.sheet.height, result.drawing->picture.rows);
  }
}

// How many stones cover each of 4 x 4 samples a pixel, by the even-odd rule, off the vertices' usual places.
constexpr int kSamples = 4;

cv::Mat1b cover(const PieceSheet& sheet, const cv::Size& size) {
  cv::Mat1b count(size.height * kSamples, size.width * kSamples, static_cast<unsigned char>(0));
  for (const Piece& stone : sheet.pieces) {
    const Ring& ring = ring_of(stone);
    for (int y = 0; y < count.rows; ++y) {
      const double at = (y + 0.5037) / kSamples;
      std::vector<double> crossings;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point a = ring[i], b = ring[(i + 1) % ring.size()];
        if ((a.y > at) != (b.y > at)) crossings.push_back(a.x + (at - a.y) / (b.y - a.y) * (b.x - a.x));
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
        const int begin = std::max(0, static_cast<int>(std::ceil(crossings[k] * kSamples - 0.5)));
        const int end = std::min(count.cols, static_cast<int>(std::ceil(crossings[k + 1] * kSamples - 0.5)));
        for (int x = begin; x < end; ++x) ++count(y, x);
      }
    }
  }
  return count;
}

// Where every pixel is an edge there is no frontier to settle on, and stones of a pixel get in each other's way a little.
TEST(Pavement, StonesHardlyOverlap) {
  for (const Paved& result : all_results()) {
    const cv::Mat1b count = cover(result.output.sheet, result.drawing->picture.size());
    const double share = cv::countNonZero(count > 1) / static_cast<double>(count.total());
    const std::string name = result.drawing->name;
    const bool one_pixel = name == "checker of one pixel" || name == "noise";
    EXPECT_LT(share, one_pixel ? 0.05 : 0.005) << result.name();
  }
}

TEST(Pavement, StonesCoverThePictureButForTheGrout) {
  for (const Paved& result : all_results()) {
    double sum = 0;
    for (const double a : result.output.areas) sum += a;
    const double share = sum / static_cast<double>(result.drawing->picture.total());
    EXPECT_LE(share, 1.005) << result.name();
    EXPECT_GE(share, result.params.grout == 0 ? 0.9 : 0.6) << result.name();
  }
}

// Connected pixels of one zone, each with its label; 4-connected.
int label_regions(const cv::Mat1b& zones, cv::Mat1i& labels, std::vector<int>& pixels, std::vector<int>& zone) {
  labels.create(zones.size());
  labels.setTo(-1);
  int regions = 0;
  for (int y = 0; y < zones.rows; ++y) {
    for (int x = 0; x < zones.cols; ++x) {
      if (labels(y, x) >= 0) continue;
      std::vector<cv::Point> open{{x, y}};
      labels(y, x) = regions;
      for (std::size_t i = 0; i < open.size(); ++i) {
        for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          const cv::Point q = open[i] + cv::Point(dx, dy);
          if (q.x < 0 || q.y < 0 || q.x >= zones.cols || q.y >= zones.rows) continue;
          if (labels(q) >= 0 || zones(q) != zones(y, x)) continue;
          labels(q) = regions;
          open.push_back(q);
        }
      }
      pixels.push_back(static_cast<int>(open.size()));
      zone.push_back(zones(y, x));
      ++regions;
    }
  }
  return regions;
}

bool contains(const Ring& ring, Point p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

// The regions, of the diagram's zones, that stones of their colour reach.
std::set<int> regions_with_stones(const Paved& result, const Fields& fields, const cv::Mat1i& labels,
                                  const std::vector<int>& zone) {
  std::set<int> reached;
  for (const Piece& stone : result.output.sheet.pieces) {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const Point p : ring_of(stone)) {
      left = std::min(left, p.x * fields.scale);
      right = std::max(right, p.x * fields.scale);
      top = std::min(top, p.y * fields.scale);
      bottom = std::max(bottom, p.y * fields.scale);
    }
    for (int y = std::max(0, static_cast<int>(top)); y < std::min<double>(labels.rows, bottom); ++y) {
      for (int x = std::max(0, static_cast<int>(left)); x < std::min<double>(labels.cols, right); ++x) {
        if (!(fields.zones.palette[zone[labels(y, x)]] == stone.fill)) continue;
        const Point centre = (1 / fields.scale) * Point{x + 0.5, y + 0.5};
        if (contains(ring_of(stone), centre)) reached.insert(labels(y, x));
      }
    }
  }
  return reached;
}

TEST(Pavement, EveryRegionOfFourPixelsHasAStone) {
  for (const Paved& result : all_results()) {
    const Fields fields = make_fields(view_of(result.drawing->picture), result.params);
    cv::Mat1i labels;
    std::vector<int> pixels, zone;
    const int regions = label_regions(fields.zones.map, labels, pixels, zone);
    const std::set<int> reached = regions_with_stones(result, fields, labels, zone);
    int missing = 0;
    for (int k = 0; k < regions; ++k) missing += pixels[k] >= 4 * fields.scale * fields.scale && !reached.count(k);
    EXPECT_EQ(missing, 0) << "of " << regions << " regions; " << result.name();
  }
}

bool same(const Output& a, const Output& b) {
  if (a.sheet.pieces.size() != b.sheet.pieces.size() || a.reseeded != b.reseeded) return false;
  for (std::size_t i = 0; i < a.sheet.pieces.size(); ++i) {
    const Piece &p = a.sheet.pieces[i], &q = b.sheet.pieces[i];
    if (ring_of(p) != ring_of(q) || !(p.fill == q.fill)) return false;
  }
  return true;
}

TEST(Pavement, SameResultOnEveryRunForAnyNumberOfThreads) {
  const int threads = cv::getNumThreads();
  for (const NamedDrawing& drawing : all_drawings()) {
    for (const Method method : {Method::kFlow, Method::kPaper}) {
      Params params;
      params.colors = drawing.colors;
      params.method = method;
      params.iterations = 5;
      cv::setNumThreads(1);
      const Output one = pave(drawing.picture, params, 3);
      for (const int n : {1, 2, 4}) {
        cv::setNumThreads(n);
        EXPECT_TRUE(same(pave(drawing.picture, params, 3), one)) << drawing.name << ", " << n << " threads";
      }
    }
  }
  cv::setNumThreads(threads);
}

// Vertices are relaxed in bands, of which smaller pictures have but one.
TEST(Pavement, ATallPictureIsTheSameForAnyNumberOfThreads) {
  const int threads = cv::getNumThreads();
  const cv::Mat3b picture = wave_drawing(40, 2100);
  Params params;
  params.iterations = 5;
  cv::setNumThreads(1);
  const Output one = pave(picture, params, 3);
  for (const int n : {2, 4}) {
    cv::setNumThreads(n);
    EXPECT_TRUE(same(pave(picture, params, 3), one)) << n << " threads";
  }
  cv::setNumThreads(threads);
}

TEST(Pavement, DifferentSeedsMakeDifferentPavements) {
  Params params;
  params.iterations = 3;
  const cv::Mat3b picture = disc_drawing();
  std::vector<Output> outputs;
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32}) {
    outputs.push_back(pave(picture, params, seed));
    for (std::size_t i = 0; i + 1 < outputs.size(); ++i) EXPECT_FALSE(same(outputs[i], outputs.back()));
  }
}

TEST(Pavement, WithoutIterationsThereAreStones) {
  for (const NamedDrawing& drawing : all_drawings()) {
    Params params;
    params.colors = drawing.colors;
    params.iterations = 0;
    EXPECT_GE(pave(drawing.picture, params, 1).sheet.pieces.size(), 1u) << drawing.name;
  }
}

TEST(Pavement, TheExtremesOfTheParametersHold) {
  const cv::Mat3b picture = wave_drawing(48, 32);
  const auto expect_sound = [&](const char* what, Params params) {
    params.iterations = std::min(params.iterations, 4);
    const Output output = pave(picture, params, 1);
    EXPECT_GE(output.sheet.pieces.size(), 1u) << what;
    for (const Piece& stone : output.sheet.pieces)
      for (const Point p : ring_of(stone)) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << what;
  };
  expect_sound("half side 1", {.half_side = 1});
  expect_sound("half side larger than the picture", {.half_side = 512});
  expect_sound("grout wider than stones", {.grout = 256});
  expect_sound("one site", {.sites = 1});
  expect_sound("more sites than pixels", {.sites = 10000});
  expect_sound("stretch", {.stretch_min = 0.1, .stretch_max = 10});
  expect_sound("no cap", {.cap_scale = 0});
  expect_sound("full cap", {.cap_scale = 1});
  expect_sound("wide angle 60", {.wide_angle = 60});
  expect_sound("wide angle 180", {.wide_angle = 180});
  expect_sound("short waves", {.noise_scale = 2});
  expect_sound("supersample", {.supersample = 4});
  expect_sound("sixteen colours", {.colors = 16});
  expect_sound("threshold", {.threshold = 1});
}

TEST(Pavement, AskedForStonesComeInAboutThatNumber) {
  for (const int wanted : {30, 100, 400}) {
    Params params;
    params.sites = wanted;
    params.iterations = 5;
    const Output output = pave(flat_drawing(120, 90, 255), params, 2);
    EXPECT_NEAR(output.sites, wanted, 1);
    EXPECT_NEAR(static_cast<double>(output.sheet.pieces.size()), wanted, 0.1 * wanted + 2);
  }
}

TEST(Pavement, NumberOfSitesIsThePapers) {
  Params params;
  params.iterations = 0;
  params.half_side = 3;
  EXPECT_EQ(pave(flat_drawing(90, 60, 255), params, 1).sites, 150);  // Eq. 1: 90 x 60 / 6^2
}

TEST(Pavement, TheObserverSeesTheFirstDiagramAndOneAnIteration) {
  const cv::Mat3b picture = disc_drawing(40);
  const auto rasterizer = make_cpu_rasterizer();
  for (const int iterations : {0, 1, 7}) {
    Params params;
    params.iterations = iterations;
    std::vector<int> seen;
    const auto observer = [&](const Iteration& iteration) {
      seen.push_back(iteration.index);
      EXPECT_EQ(iteration.last, iterations);
      EXPECT_EQ(iteration.labels.cols, std::lround(40 * iteration.scale));
      EXPECT_FALSE(iteration.sites.empty());
      for (const Site& site : iteration.sites) ASSERT_LT(site.zone, iteration.palette.size());
      for (const int l : iteration.labels) ASSERT_LT(l, static_cast<int>(iteration.sites.size()));
    };
    ASSERT_TRUE(run(view_of(picture), params, 1, *rasterizer, {}, observer));
    ASSERT_EQ(static_cast<int>(seen.size()), iterations + 1);
    for (int i = 0; i <= iterations; ++i) EXPECT_EQ(seen[i], i);
  }
}

TEST(Pavement, ProgressNeverFallsAndEndsAtOne) {
  std::vector<double> progress;
  std::vector<std::string> stages;
  RunContext context;
  context.on_progress = [&](double fraction) { progress.push_back(fraction); };
  context.on_stage = [&](std::string_view stage) { stages.emplace_back(stage); };
  const auto rasterizer = make_cpu_rasterizer();
  ASSERT_TRUE(run(view_of(disc_drawing(40)), {}, 1, *rasterizer, context));
  ASSERT_FALSE(progress.empty());
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_GE(progress.front(), 0);
  EXPECT_EQ(progress.back(), 1);
  EXPECT_GE(stages.size(), 2u);
  EXPECT_EQ(std::set<std::string>(stages.begin(), stages.end()).size(), stages.size());
}

void expect_stopped(StopReason reason, StatusCode code, int diagrams) {
  std::atomic<int> stop{diagrams == 0 ? static_cast<int>(reason) : 0};
  RunContext context;
  context.stop = &stop;
  int seen = 0;
  const auto observer = [&](const Iteration&) {
    if (++seen == diagrams) stop = static_cast<int>(reason);
  };
  const cv::Mat3b picture = disc_drawing(40);
  const auto rasterizer = make_cpu_rasterizer();
  const auto output = run(view_of(picture), {}, 1, *rasterizer, context, observer);
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, code);
  EXPECT_EQ(seen, diagrams);
}

TEST(Pavement, TheStopFlagEndsTheRun) {
  for (const int diagrams : {0, 1, 5, 20}) {
    expect_stopped(StopReason::kCancelled, StatusCode::kCancelled, diagrams);
    expect_stopped(StopReason::kTimeout, StatusCode::kTimeout, diagrams);
  }
}

TEST(Pavement, APictureWithoutPixelsIsRefused) {
  const auto rasterizer = make_cpu_rasterizer();
  for (const ImageView& view : {ImageView{}, ImageView{nullptr, 0, 5, 0}, ImageView{nullptr, 5, 0, 15}}) {
    const auto output = run(view, {}, 1, *rasterizer, {});
    ASSERT_FALSE(output);
    EXPECT_EQ(output.error().code, StatusCode::kInvalidInput);
    EXPECT_FALSE(output.error().message.empty());
  }
}

TEST(Pavement, TheDrawingIsOnlyRead) {
  for (const NamedDrawing& drawing : all_drawings()) {
    for (const int supersample : {0, 1, 3}) {
      const cv::Mat3b picture = drawing.picture.clone();
      Params params;
      params.colors = drawing.colors;
      params.supersample = supersample;
      params.iterations = 0;
      pave(picture, params, 1);
      EXPECT_EQ(cv::norm(picture, drawing.picture, cv::NORM_INF), 0)
          << drawing.name << ", supersample " << supersample;
    }
  }
}

TEST(Pavement, RowsMayBePadded) {
  const cv::Mat3b picture = wave_drawing(48, 40);
  cv::Mat3b wide(40, 71, cv::Vec3b(1, 200, 3));
  picture.copyTo(wide(cv::Rect(9, 0, 48, 40)));
  Params params;
  params.iterations = 3;
  EXPECT_TRUE(same(pave(wide(cv::Rect(9, 0, 48, 40)), params, 1), pave(picture, params, 1)));
}

TEST(Pavement, ThePapersMethodGivesAStoneACell) {
  for (const NamedDrawing& drawing : all_drawings()) {
    Params params;
    params.colors = drawing.colors;
    params.method = Method::kPaper;
    params.iterations = 10;
    const Output output = pave(drawing.picture, params, 1);
    ASSERT_GE(output.sheet.pieces.size(), 1u) << drawing.name;
    for (const Piece& stone : output.sheet.pieces)
      for (const Point p : ring_of(stone)) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << drawing.name;
  }
  Params params;
  params.method = Method::kPaper;
  params.grout = 0;
  const Output output = pave(flat_drawing(100, 80, 255), params, 1);
  double sum = 0;
  for (const double a : output.areas) sum += a;
  EXPECT_NEAR(sum / (100 * 80), 1, 0.1);
}

}  // namespace
}  // namespace tessera::pavement

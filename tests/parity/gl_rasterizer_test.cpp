// The OpenGL backend against a plain double-precision search and against the CPU backend.
#include "tessera/gpu/gl_rasterizer.h"

#include <GLES3/gl3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "gl_context.h"
#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"
#include "tessera/voronoi/cpu_rasterizer.h"
#include "tessera/voronoi/fallback_rasterizer.h"

namespace tessera {
namespace {

constexpr double kTolerance = 0.005;  // as gl_rasterizer.h states it
constexpr double kNowhere = std::numeric_limits<double>::infinity();

double distance_to(const Site& site, double x, double y, Metric metric) {
  const double dx = x - site.x, dy = y - site.y;
  const double c = std::cos(site.angle), s = std::sin(site.angle);
  const double u = std::abs(c * dx + s * dy), v = std::abs(c * dy - s * dx);
  if (metric == Metric::kChebyshev) return std::max(u / site.extent_u, v / site.extent_v);
  const double a = u - site.extent_u, b = v - site.extent_v;
  return a <= 0 && b <= 0 ? std::max(a, b) : std::hypot(std::max(a, 0.0), std::max(b, 0.0));
}

struct Canvas {
  cv::Mat1b zones;
  Metric metric;
  double reach;
};

// Of the site with this label, at the pixel's centre; infinite for kUnlabelled and for sites of other zones.
double distance_of_label(const Canvas& canvas, const Sites& sites, int label, int x, int y) {
  if (label == kUnlabelled || sites[label].zone != canvas.zones(y, x)) return kNowhere;
  return distance_to(sites[label], x + 0.5, y + 0.5, canvas.metric);
}

LabelMap search_all(const Canvas& canvas, const Sites& sites) {
  LabelMap labels(canvas.zones.size(), kUnlabelled);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      double best = canvas.reach;
      for (int i = 0; i < static_cast<int>(sites.size()); ++i) {
        const double d = distance_of_label(canvas, sites, i, x, y);
        if (d > best || (d == best && labels(y, x) != kUnlabelled)) continue;
        best = d;
        labels(y, x) = i;
      }
    }
  }
  return labels;
}

// Zones in stripes and blocks of a few pixels, so that their borders are everywhere.
cv::Mat1b random_zones(const cv::Size& size, int zones, Rng& rng) {
  const int block_x = 1 + static_cast<int>(rng.uniform(0, 20)), block_y = 1 + static_cast<int>(rng.uniform(0, 20));
  const int first = static_cast<int>(rng.uniform(0, 256 - zones + 1));
  cv::Mat1b map(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      map(y, x) = static_cast<std::uint8_t>(first + (x / block_x + 3 * (y / block_y)) % zones);
  return map;
}

// Some lie outside the canvas; zones are those of the canvas.
Sites random_sites(const Canvas& canvas, int count, double extent, Rng& rng) {
  const auto anywhere = [&](int length) { return snap_position(rng.uniform(-4, length + 4)); };
  const auto one_of = [&](int length) { return static_cast<int>(rng.uniform(0, length)); };
  const double least = canvas.metric == Metric::kChebyshev ? 0.3 * extent : 0;
  Sites sites(count);
  for (Site& site : sites) {
    site.x = anywhere(canvas.zones.cols);
    site.y = anywhere(canvas.zones.rows);
    site.angle = snap_angle(rng.uniform(-7, 7));
    site.extent_u = static_cast<float>(rng.uniform(least, extent));
    site.extent_v = static_cast<float>(rng.uniform(least, extent));
    site.zone = canvas.zones(one_of(canvas.zones.rows), one_of(canvas.zones.cols));
  }
  return sites;
}

// GL's grid for vertices, in the unit of distances.
double subpixel(const Canvas& canvas, const Sites& sites) {
  GLint bits = 0;
  glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
  double unit = 1;
  if (canvas.metric == Metric::kChebyshev)
    for (const Site& site : sites) unit = std::min<double>({unit, site.extent_u, site.extent_v});
  return std::ldexp(1.0, -bits) / unit;
}

bool same(const LabelMap& a, const LabelMap& b) { return a.size() == b.size() && cv::countNonZero(a != b) == 0; }

class GlRasterizerTest : public testing::Test {
 protected:
  void SetUp() override {
    Result<GlContext> context = GlContext::create();
    if (!context) GTEST_SKIP() << context.error().message;
    context_.emplace(std::move(*context));
    gl_ = make();
  }

  static std::unique_ptr<Rasterizer> make(const GlRasterizerOptions& options = {}) {
    Result<std::unique_ptr<Rasterizer>> made = make_gl_rasterizer(options);
    EXPECT_TRUE(made) << made.error().message;
    return made ? std::move(*made) : nullptr;
  }

  static LabelMap label(Rasterizer& rasterizer, const Canvas& canvas, const Sites& sites) {
    LabelMap labels;
    const Result<void> begun = rasterizer.begin(canvas.zones, canvas.metric, canvas.reach);
    EXPECT_TRUE(begun) << begun.error().message;
    const Result<void> done = rasterizer.label(sites, labels);
    EXPECT_TRUE(done) << done.error().message;
    EXPECT_EQ(labels.size(), canvas.zones.size());
    return labels;
  }
  LabelMap label(const Canvas& canvas, const Sites& sites) { return label(*gl_, canvas, sites); }

  std::optional<GlContext> context_;
  std::unique_ptr<Rasterizer> gl_;  // before the context goes
};

// How many pixels two backends label differently, over many canvases.
struct Agreement {
  long pixels = 0, differ = 0;
  // How much farther than the nearest site, as a part of the distance, at a differing pixel; but for what GL may move
  // vertices by.
  double worst = 0;

  void count(const Canvas& canvas, const Sites& sites, const LabelMap& labels, const LabelMap& expected) {
    pixels += static_cast<long>(labels.total());
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) {
        if (labels(y, x) == expected(y, x)) continue;
        ++differ;
        // Unlabelled counts as just out of reach.
        const auto distance = [&](int label) {
          return label == kUnlabelled ? canvas.reach : distance_of_label(canvas, sites, label, x, y);
        };
        const double nearest = distance(expected(y, x));
        const double farther = distance(labels(y, x)) - nearest - subpixel(canvas, sites);
        worst = std::max(worst, farther / std::max(1.0, nearest));
      }
    }
  }
};

class GlRasterizerParity : public GlRasterizerTest, public testing::WithParamInterface<Metric> {
 protected:
  // Calls use(canvas, sites) for canvases of all shapes, with few and many zones and sites.
  template <class Use>
  void for_random_canvases(Use&& use) {
    const cv::Size sizes[] = {{1, 1}, {1, 37}, {53, 1}, {2, 2}, {8, 8}, {31, 17}, {64, 64}, {101, 67}, {130, 129}};
    for (int seed = 0; seed < 12; ++seed) {
      for (const cv::Size& size : sizes) {
        Rng rng(seed * 1000 + size.area(), RngPurpose::kSites);
        const bool chebyshev = GetParam() == Metric::kChebyshev;
        Canvas canvas{random_zones(size, 1 + seed % 5, rng), GetParam(),
                      chebyshev ? rng.uniform(1, 12) : rng.uniform(2, 90)};
        use(canvas, random_sites(canvas, 1 + static_cast<int>(rng.uniform(0, 90)), chebyshev ? 6 : 5, rng));
      }
    }
  }
};

TEST_P(GlRasterizerParity, AgreesWithASearchInDoublePrecision) {
  Agreement agreement;
  for_random_canvases([&](const Canvas& canvas, const Sites& sites) {
    agreement.count(canvas, sites, label(canvas, sites), search_all(canvas, sites));
  });
  EXPECT_LE(agreement.differ, agreement.pixels / 1000);
  EXPECT_LT(agreement.worst, kTolerance);
}

TEST_P(GlRasterizerParity, AgreesWithTheCpuBackend) {
  const std::unique_ptr<Rasterizer> cpu = make_cpu_rasterizer();
  Agreement agreement;
  for_random_canvases([&](const Canvas& canvas, const Sites& sites) {
    agreement.count(canvas, sites, label(canvas, sites), label(*cpu, canvas, sites));
  });
  EXPECT_LE(agreement.differ, agreement.pixels / 1000);
  EXPECT_LT(agreement.worst, kTolerance);
}

TEST_P(GlRasterizerParity, AgreesWithTheCpuBackendOnManySites) {
  Rng rng(5, RngPurpose::kSites);
  const bool chebyshev = GetParam() == Metric::kChebyshev;
  const Canvas canvas{random_zones({300, 211}, 3, rng), GetParam(), chebyshev ? 10.0 : 30.0};
  const Sites sites = random_sites(canvas, 2000, chebyshev ? 4 : 3, rng);
  Agreement agreement;
  agreement.count(canvas, sites, label(canvas, sites), label(*make_cpu_rasterizer(), canvas, sites));
  EXPECT_LE(agreement.differ, agreement.pixels / 1000);
}

// Single precision must reach to the far corner: the same sites give the same cells there as at the origin.
TEST_P(GlRasterizerParity, IsAsExactFarFromTheOrigin) {
  Rng rng(6, RngPurpose::kSites);
  const Canvas near{random_zones({60, 40}, 2, rng), GetParam(), 20};
  Sites sites = random_sites(near, 50, 4, rng);
  const LabelMap expected = search_all(near, sites);
  const cv::Rect corner(8192 - 60, 0, 60, 40);
  Canvas far{cv::Mat1b(40, 8192, std::uint8_t{255}), GetParam(), 20};
  near.zones.copyTo(far.zones(corner));
  for (Site& site : sites) site.x += corner.x;
  const LabelMap labels = label(*make({.tile_limit = 8192}), far, sites)(corner);
  EXPECT_LE(cv::countNonZero(labels != expected), corner.area() / 1000);
}

TEST_P(GlRasterizerParity, OfIdenticalSitesTheFirstWins) {
  Rng rng(7, RngPurpose::kSites);
  const Canvas canvas{random_zones({70, 50}, 2, rng), GetParam(), 200};
  const Sites once = random_sites(canvas, 20, 5, rng);
  Sites twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  const LabelMap labels = label(canvas, twice);
  EXPECT_TRUE(same(labels, label(canvas, once)));
}

// Sites on a grid of odd spacing: pixels midway between two, and between four, tie exactly.
TEST_P(GlRasterizerParity, TiesOnAGridGoToTheLowerIndex) {
  Rng rng(8, RngPurpose::kSites);
  const Canvas canvas{cv::Mat1b(77, 77, std::uint8_t{3}), GetParam(), 20};
  Sites sites;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) sites.push_back({10.0 * x + 3.5, 10.0 * y + 3.5, 0, 1, 1, 3});
  // Tiles of 9 px and their neighbours: some end at pixels that tie.
  const std::unique_ptr<Rasterizer> tiled = make({.tile_limit = 11});
  for (int shuffle = 0; shuffle < 5; ++shuffle) {
    const LabelMap expected = search_all(canvas, sites);
    EXPECT_TRUE(same(label(canvas, sites), expected)) << "order " << shuffle;
    EXPECT_TRUE(same(label(*tiled, canvas, sites), expected)) << "order " << shuffle;
    for (std::size_t i = sites.size() - 1; i > 0; --i)
      std::swap(sites[i], sites[static_cast<std::size_t>(rng.uniform(0, i + 1.0))]);
  }
}

TEST_P(GlRasterizerParity, NothingBeyondTheReachIsLabelled) {
  const Canvas canvas{cv::Mat1b(60, 60, std::uint8_t{0}), GetParam(), 10.25};
  const Sites sites = {{30.25, 29.75, 0.5, 2, 1, 0}};
  const LabelMap labels = label(canvas, sites);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double d = distance_to(sites[0], x + 0.5, y + 0.5, canvas.metric);
      if (std::abs(d - canvas.reach) < 1e-4) continue;
      EXPECT_EQ(labels(y, x), d < canvas.reach ? 0 : kUnlabelled) << x << ' ' << y;
    }
  }
}

TEST_P(GlRasterizerParity, AnEndlessReachLabelsEverything) {
  const Canvas canvas{cv::Mat1b(40, 90, std::uint8_t{1}), GetParam(), kNowhere};
  const Sites sites = {{-300, 20, 0.3, 1, 2, 1}, {500, -100, 1, 2, 2, 1}};
  EXPECT_TRUE(same(label(canvas, sites), search_all(canvas, sites)));
}

TEST_P(GlRasterizerParity, ZonesKeepToThemselves) {
  Canvas canvas{cv::Mat1b(20, 30, std::uint8_t{0}), GetParam(), 100};
  canvas.zones.colRange(10, 20) = 129;
  canvas.zones.colRange(20, 30) = 255;
  // The site of zone 129 lies in zone 0, and nobody answers for zone 255; zone 7 has no pixels.
  const Sites sites = {{5, 5, 0, 1, 1, 129}, {25, 5, 0, 1, 1, 0}, {15, 15, 0, 1, 1, 7}};
  const LabelMap labels = label(canvas, sites);
  EXPECT_TRUE(same(labels.colRange(0, 10), LabelMap(20, 10, 1)));
  EXPECT_TRUE(same(labels.colRange(10, 20), LabelMap(20, 10, 0)));
  EXPECT_TRUE(same(labels.colRange(20, 30), LabelMap(20, 10, kUnlabelled)));
}

TEST_P(GlRasterizerParity, EveryZoneNumberIsItsOwn) {
  Canvas canvas{cv::Mat1b(16, 16), GetParam(), 100};
  Sites sites;
  for (int zone = 0; zone < 256; ++zone) {
    canvas.zones(zone / 16, zone % 16) = static_cast<std::uint8_t>(zone);
    sites.push_back({8, 8, 0, 1, 1, static_cast<std::uint8_t>(255 - zone)});
  }
  EXPECT_TRUE(same(label(canvas, sites), search_all(canvas, sites)));
}

TEST_P(GlRasterizerParity, NoSitesNoLabels) {
  const Canvas canvas{cv::Mat1b(9, 13, std::uint8_t{2}), GetParam(), 10};
  EXPECT_TRUE(same(label(canvas, {}), LabelMap(9, 13, kUnlabelled)));
}

TEST_P(GlRasterizerParity, TilesMakeNoDifference) {
  Rng rng(9, RngPurpose::kSites);
  const bool chebyshev = GetParam() == Metric::kChebyshev;
  const Canvas canvas{random_zones({150, 97}, 3, rng), GetParam(), chebyshev ? 8.0 : 40.0};
  const Sites sites = random_sites(canvas, 120, 5, rng);
  const LabelMap whole = label(canvas, sites);
  for (const int limit : {32, 37, 97, 149}) {
    const std::unique_ptr<Rasterizer> tiled = make({.tile_limit = limit});
    EXPECT_TRUE(same(label(*tiled, canvas, sites), whole)) << "tiles of " << limit;
  }
}

TEST_P(GlRasterizerParity, OneRasterizerServesManyCanvases) {
  const std::unique_ptr<Rasterizer> reused = make({.tile_limit = 64});
  for_random_canvases([&](const Canvas& canvas, const Sites& sites) {
    const LabelMap first = label(*reused, canvas, sites);
    LabelMap again;
    ASSERT_TRUE(reused->label(sites, again));
    EXPECT_TRUE(same(first, again));
    EXPECT_TRUE(same(first, label(*make({.tile_limit = 64}), canvas, sites)));
  });
}

INSTANTIATE_TEST_SUITE_P(Metrics, GlRasterizerParity, testing::Values(Metric::kFrustum, Metric::kChebyshev),
                         [](const auto& metric) {
                           return metric.param == Metric::kFrustum ? "Frustum" : "Chebyshev";
                         });

// Points with extents 0: what a Euclidean Voronoi diagram is made of.
TEST_F(GlRasterizerTest, PointsGiveTheEuclideanDiagram) {
  Rng rng(10, RngPurpose::kSites);
  const Canvas canvas{cv::Mat1b(120, 160, std::uint8_t{0}), Metric::kFrustum, 300};
  const Sites sites = random_sites(canvas, 80, 0, rng);
  Agreement agreement;
  agreement.count(canvas, sites, label(canvas, sites), search_all(canvas, sites));
  EXPECT_LE(agreement.differ, agreement.pixels / 1000);
}

// Deep inside two overlapping rectangles the one whose border is farther wins.
TEST_F(GlRasterizerTest, InsideOverlappingRectanglesTheDeeperOneWins) {
  const Canvas canvas{cv::Mat1b(80, 80, std::uint8_t{0}), Metric::kFrustum, 5};
  const Sites sites = {{36, 40, 0.25, 30, 8, 0}, {44, 40, 1.0, 20, 14, 0}, {40, 30, -0.5, 6, 25, 0}};
  EXPECT_LE(cv::countNonZero(label(canvas, sites) != search_all(canvas, sites)), 6);
}

TEST_F(GlRasterizerTest, AMatrixThatIsPartOfAnotherIsReadAndWrittenInPlace) {
  Rng rng(11, RngPurpose::kSites);
  const cv::Mat1b wide = random_zones({90, 50}, 3, rng);
  const cv::Rect part(13, 7, 41, 33);
  const Canvas view{wide(part), Metric::kFrustum, 50}, copy{wide(part).clone(), Metric::kFrustum, 50};
  const Sites sites = random_sites(copy, 30, 3, rng);
  const LabelMap expected = label(copy, sites);
  LabelMap frame(50, 90, 12345), into = frame(part);
  ASSERT_TRUE(gl_->begin(view.zones, view.metric, view.reach));
  ASSERT_TRUE(gl_->label(sites, into));
  EXPECT_TRUE(same(frame(part), expected));
  frame(part) = 12345;
  EXPECT_EQ(cv::countNonZero(frame != 12345), 0);
}

TEST_F(GlRasterizerTest, AnEmptyCanvasIsNoError) {
  LabelMap labels(3, 3);
  ASSERT_TRUE(gl_->begin(cv::Mat1b(), Metric::kFrustum, 10));
  ASSERT_TRUE(gl_->label({{1, 1, 0, 1, 1, 0}}, labels));
  EXPECT_TRUE(labels.empty());
}

TEST_F(GlRasterizerTest, OtherWorkOnTheContextDoesNotShow) {
  Rng rng(12, RngPurpose::kSites);
  const Canvas canvas{random_zones({70, 50}, 3, rng), Metric::kFrustum, 30};
  const Sites sites = random_sites(canvas, 40, 3, rng);
  const LabelMap expected = label(canvas, sites);

  const std::unique_ptr<Rasterizer> other = make();
  label(*other, {cv::Mat1b(9, 11, std::uint8_t{1}), Metric::kChebyshev, 3}, {{4, 4, 0, 1, 1, 1}});
  for (const GLenum capability : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_RASTERIZER_DISCARD})
    glEnable(capability);
  glBlendFunc(GL_ZERO, GL_ONE);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glDepthRangef(0.25f, 0.5f);
  glStencilMask(0);
  glViewport(1, 2, 3, 4);
  glScissor(1, 2, 3, 4);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  glPixelStorei(GL_PACK_ROW_LENGTH, 5);
  LabelMap again;
  ASSERT_TRUE(gl_->label(sites, again));
  EXPECT_TRUE(same(again, expected));
}

TEST_F(GlRasterizerTest, TwoContextsLiveSideBySide) {
  const Canvas canvas{cv::Mat1b(20, 20, std::uint8_t{0}), Metric::kFrustum, 100};
  const Sites sites = {{5, 5, 0, 1, 1, 0}, {15, 12, 0, 1, 1, 0}};
  const LabelMap expected = label(canvas, sites);
  {
    Result<GlContext> second = GlContext::create();
    ASSERT_TRUE(second);
    EXPECT_FALSE(second->renderer().empty());
    EXPECT_TRUE(same(label(*make(), canvas, sites), expected));
  }
  ASSERT_TRUE(context_->make_current());
  EXPECT_TRUE(same(label(canvas, sites), expected));
}

#ifdef __EMSCRIPTEN__

TEST_F(GlRasterizerTest, ALostContextIsAnError) {
  const Canvas canvas{cv::Mat1b(20, 20, std::uint8_t{0}), Metric::kFrustum, 10};
  const Sites sites = {{5, 5, 0, 1, 1, 0}};
  label(canvas, sites);
  context_->lose();
  LabelMap labels;
  const Result<void> done = gl_->label(sites, labels);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, StatusCode::kInternal);
}

TEST_F(GlRasterizerTest, AfterALostContextTheCpuTakesOver) {
  const Canvas canvas{cv::Mat1b(20, 20, std::uint8_t{0}), Metric::kFrustum, 10};
  const Sites sites = {{5, 5, 0, 1, 1, 0}, {15, 12, 0, 1, 1, 0}};
  const LabelMap expected = label(*gl_, canvas, sites);
  std::string reason;
  const auto both = make_fallback_rasterizer(std::move(gl_), make_cpu_rasterizer(),
                                             [&](const Status& status) { reason = status.message; });
  ASSERT_TRUE(both->begin(canvas.zones, canvas.metric, canvas.reach));
  context_->lose();
  LabelMap labels;
  ASSERT_TRUE(both->label(sites, labels));
  EXPECT_FALSE(reason.empty());
  EXPECT_EQ(both->name(), "cpu");
  EXPECT_TRUE(same(labels, expected));
}

#else

TEST_F(GlRasterizerTest, WithoutAContextTheFactorySaysSo) {
  gl_.reset();
  context_->release();
  const Result<std::unique_ptr<Rasterizer>> made = make_gl_rasterizer();
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, StatusCode::kInternal);
  EXPECT_NE(made.error().message.find("no context"), std::string::npos) << made.error().message;
}

TEST_F(GlRasterizerTest, AContextThatGoesAwayIsAnError) {
  const Canvas canvas{cv::Mat1b(20, 20, std::uint8_t{0}), Metric::kFrustum, 10};
  const Sites sites = {{5, 5, 0, 1, 1, 0}};
  label(canvas, sites);
  context_->release();
  LabelMap labels;
  const Result<void> done = gl_->label(sites, labels);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, StatusCode::kInternal);
  ASSERT_TRUE(context_->make_current());
  EXPECT_TRUE(gl_->label(sites, labels));
}

#endif

}  // namespace
}  // namespace tessera

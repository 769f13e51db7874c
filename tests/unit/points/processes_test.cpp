#include "tessera/points/processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tessera/base/distributions.h"
#include "tessera/base/portable_math.h"
#include "tessera/points/point_grid.h"

namespace tessera {
namespace {

constexpr int kSeeds = 200;

using Process = std::function<std::vector<Point>(const Window&, Rng&)>;

struct Estimate {
  double mean = 0, error = 0;  // of the mean

  bool agrees_with(double expected) const { return std::abs(mean - expected) <= 3.5 * error; }
};

Estimate estimate(const std::vector<double>& values) {
  Estimate e;
  const double n = static_cast<double>(values.size());
  for (const double v : values) e.mean += v / n;
  double squares = 0;
  for (const double v : values) squares += (v - e.mean) * (v - e.mean);
  e.error = std::sqrt(squares / (n - 1) / n);
  return e;
}

template <class Measure>
Estimate over_seeds(const Window& window, const Process& process, const Measure& measure) {
  std::vector<double> values;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kSites);
    values.push_back(measure(process(window, rng)));
  }
  return estimate(values);
}

Estimate intensity_of(const Window& window, const Process& process) {
  return over_seeds(window, process,
                    [&](const auto& points) { return static_cast<double>(points.size()) / window.area(); });
}

// Ordered pairs nearer than t in a periodic window, an area: lambda^2 K(t).
Estimate pairs_of(const Window& window, const Process& process, double t) {
  return over_seeds(window, process, [&](const std::vector<Point>& points) {
    const PointGrid grid(points, window, t);
    double pairs = -static_cast<double>(points.size());  // each with itself
    for (const Point p : points)
      grid.each_near(p, t, [&](int, Point) {
        ++pairs;
        return true;
      });
    return pairs / window.area();
  });
}

const Window kOpen{{-3, 2}, {37, 32}}, kRound{{-3, 2}, {37, 32}, true};

struct Case {
  const char* name;
  Process process;
  double intensity;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"poisson", [](const Window& w, Rng& r) { return poisson_points(w, 0.3, r); }, 0.3},
      {"binomial", [](const Window& w, Rng& r) { return binomial_points(w, 0.3, 0.5, r); },
       (1 - std::exp(-0.3 * 0.25)) / 0.25},
      {"cluster", [](const Window& w, Rng& r) { return cluster_points(w, 0.05, 6, 1.5, r); }, 0.3},
      {"matern 1", [](const Window& w, Rng& r) { return matern1_points(w, 0.4, 0.3, r); },
       0.4 * std::exp(-4 * kPi * 0.4 * 0.09)},
      {"matern 2", [](const Window& w, Rng& r) { return matern2_points(w, 0.8, 0.4, r); },
       (1 - std::exp(-4 * kPi * 0.8 * 0.16)) / (4 * kPi * 0.16)},
      {"mixed", [](const Window& w, Rng& r) { return mixed_points(w, 0.3, 0.5, r); }, 0.3},
      {"cox", [](const Window& w, Rng& r) { return density_points(w, 0.3, log_gaussian_density(w, 2, 0.7, r), r); },
       0.3}};
  return all;
}

TEST(PointProcessTest, HasTheIntensityOfItsClosedForm) {
  for (const Case& c : cases())
    for (const Window& window : {kOpen, kRound}) {
      const Estimate found = intensity_of(window, c.process);
      EXPECT_TRUE(found.agrees_with(c.intensity)) << c.name << " " << found.mean << " +- " << found.error;
    }
}

TEST(PointProcessTest, PointsLieInTheWindow) {
  for (const Case& c : cases())
    for (const Window& window : {kOpen, kRound})
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Rng rng(seed, RngPurpose::kSites);
        for (const Point p : c.process(window, rng)) ASSERT_TRUE(window.holds(p)) << c.name;
      }
}

// An edge that knows of nothing outside would have more points of an inhibited process, and fewer of a cluster's.
TEST(PointProcessTest, IsStationaryUpToTheBorder) {
  for (const Case& c : cases()) {
    if (std::string(c.name) == "binomial") continue;  // its grid begins at the corner
    const Estimate strip = over_seeds(kOpen, c.process, [](const auto& points) {
      double count = 0;
      for (const Point p : points) count += p.x < kOpen.low.x + 1 ? 1 : 0;
      return count / kOpen.size().y;
    });
    EXPECT_TRUE(strip.agrees_with(c.intensity)) << c.name << " " << strip.mean << " +- " << strip.error;
  }
}

TEST(PointProcessTest, PairsOfPoissonClusterAndMatern) {
  const double t = 2;
  const Process poisson = [](const Window& w, Rng& r) { return poisson_points(w, 0.3, r); };
  EXPECT_TRUE(pairs_of(kRound, poisson, t).agrees_with(0.09 * kPi * t * t));

  const double parents = 0.05, family = 6, spread = 1.5, lambda = parents * family;
  const Process cluster = [=](const Window& w, Rng& r) { return cluster_points(w, parents, family, spread, r); };
  const double k = kPi * t * t + (1 - std::exp(-t * t / (4 * spread * spread))) / parents;
  const Estimate found = pairs_of(kRound, cluster, t);
  EXPECT_TRUE(found.agrees_with(lambda * lambda * k)) << found.mean << " +- " << found.error;

  // Matern I: g = alpha^2 exp(-alpha U(s)) beyond 2d, U the union of two discs of radius 2d.
  const double alpha = 0.4, d = 0.3, r = 2 * d;
  double expected = 0;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    const double s = r + (t - r) * (i + 0.5) / kSteps;
    const double lens = s < 2 * r ? 2 * r * r * std::acos(s / (2 * r)) - s / 2 * std::sqrt(4 * r * r - s * s) : 0;
    expected += 2 * kPi * s * alpha * alpha * std::exp(-alpha * (2 * kPi * r * r - lens)) * (t - r) / kSteps;
  }
  const Process matern = [=](const Window& w, Rng& rng) { return matern1_points(w, alpha, d, rng); };
  const Estimate pairs = pairs_of(kRound, matern, t);
  EXPECT_TRUE(pairs.agrees_with(expected)) << pairs.mean << " +- " << pairs.error << " against " << expected;
}

TEST(PointProcessTest, PointsKeepTheirDistance) {
  for (const Window& window : {kOpen, kRound})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Rng rng(seed, RngPurpose::kSites);
      const std::pair<std::vector<Point>, double> kept[] = {{matern1_points(window, 0.5, 0.4, rng), 0.8},
                                                            {matern2_points(window, 0.9, 0.4, rng), 0.8},
                                                            {blue_noise_points(window, 1.1, rng), 1.1}};
      for (const auto& [kept_points, distance] : kept) {
        const auto& points = kept_points;  // clang 14 captures no structured binding
        const PointGrid grid(points, window, distance);
        for (std::size_t i = 0; i < points.size(); ++i)
          ASSERT_TRUE(grid.each_near(points[i], distance * (1 - 1e-12), [&](int k, Point place) {
            return k == static_cast<int>(i) && place == points[i];
          }));
      }
    }
}

// Half of what random discs can cover at most, and no hole for another.
TEST(PointProcessTest, BlueNoiseFillsTheWindow) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed, RngPurpose::kSites);
    const auto points = blue_noise_points(kRound, 1.1, rng);
    const PointGrid grid(points, kRound, 2.2);
    for (int i = 0; i < 2000; ++i) {
      const double x = rng.uniform(kRound.low.x, kRound.high.x);
      const Point p{x, rng.uniform(kRound.low.y, kRound.high.y)};
      ASSERT_FALSE(grid.each_near(p, 2.2, [](int, Point) { return false; }));
    }
    EXPECT_GT(static_cast<double>(points.size()) * 1.1 * 1.1 / kRound.area(), 0.6);
  }
}

TEST(PointProcessTest, NothingComesOfNothing) {
  Rng rng(1, RngPurpose::kSites);
  EXPECT_TRUE(poisson_points(kOpen, 0, rng).empty());
  EXPECT_TRUE(poisson_points({{1, 1}, {1, 5}}, 10, rng).empty());
  EXPECT_TRUE(binomial_points(kOpen, 0, 1, rng).empty());
  EXPECT_TRUE(cluster_points(kOpen, 0, 5, 1, rng).empty());
  EXPECT_TRUE(cluster_points(kOpen, 1, 0, 1, rng).empty());
  EXPECT_TRUE(matern1_points(kOpen, 0, 1, rng).empty());
  EXPECT_TRUE(matern2_points(kOpen, 0, 1, rng).empty());
}

TEST(GaussianFieldTest, HasItsMeanVarianceAndCovariance) {
  for (const Window& window : {kOpen, kRound}) {
    std::vector<double> means, squares, products;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kIntensity);
      const Density field = gaussian_field(window, 3, rng);
      const double one = field.at({5, 9}), other = field.at({7, 9});
      means.push_back(one);
      squares.push_back(one * one);
      products.push_back(one * other);
    }
    EXPECT_TRUE(estimate(means).agrees_with(0));
    EXPECT_TRUE(estimate(squares).agrees_with(1));
    EXPECT_TRUE(estimate(products).agrees_with(std::exp(-4.0 / 18)));
  }
}

TEST(PointGridTest, FindsWhatASearchOfAllFinds) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    for (const Window& window : {kOpen, kRound}) {
      Rng rng(seed, RngPurpose::kSites);
      const auto points = poisson_points(window, 0.05 * rng.uniform(), rng);
      const double radius = rng.uniform(0.1, 25), x = rng.uniform(-10, 40);
      const Point p{x, rng.uniform(-10, 40)};
      std::size_t expected = 0, found = 0;
      const int turns = window.periodic ? 3 : 0;
      for (const Point q : points)
        for (int i = -turns; i <= turns; ++i)
          for (int j = -turns; j <= turns; ++j)
            expected += length(q + Point{i * window.size().x, j * window.size().y} - p) <= radius ? 1 : 0;
      PointGrid(points, window, rng.uniform(0.5, 20)).each_near(p, radius, [&](int, Point place) {
        EXPECT_LE(length(place - p), radius);
        ++found;
        return true;
      });
      EXPECT_EQ(found, expected);
    }
}

TEST(DistributionsTest, HaveTheirMoments) {
  Rng rng(7, RngPurpose::kSites);
  for (const double mean : {0.3, 4.0, 250.0}) {
    std::vector<double> values, squares;
    for (int i = 0; i < 20000; ++i) {
      values.push_back(static_cast<double>(draw_poisson(mean, rng)));
      squares.push_back((values.back() - mean) * (values.back() - mean));
    }
    EXPECT_TRUE(estimate(values).agrees_with(mean));
    EXPECT_TRUE(estimate(squares).agrees_with(mean));
  }
  std::vector<double> normal, square, gamma, gamma_square;
  for (int i = 0; i < 20000; ++i) {
    normal.push_back(draw_normal(rng));
    square.push_back(normal.back() * normal.back());
    gamma.push_back(draw_gamma(4, rng));
    gamma_square.push_back((gamma.back() - 1) * (gamma.back() - 1));
  }
  EXPECT_TRUE(estimate(normal).agrees_with(0));
  EXPECT_TRUE(estimate(square).agrees_with(1));
  EXPECT_TRUE(estimate(gamma).agrees_with(1));
  EXPECT_TRUE(estimate(gamma_square).agrees_with(0.25));
}

// The same on every platform: these are what Debian's native build draws.
TEST(DistributionsTest, AreTheSameEverywhere) {
  Rng rng(1, RngPurpose::kSites);
  std::vector<std::int64_t> counts;
  for (int i = 0; i < 4; ++i) counts.push_back(draw_poisson(30, rng));
  const double normal = draw_normal(rng), gamma = draw_gamma(2.5, rng);
  EXPECT_THAT(counts, testing::ElementsAre(26, 34, 34, 26));
  EXPECT_NEAR(normal, -2.9471820000024422, 1e-12);
  EXPECT_NEAR(gamma, 0.36829360394666999, 1e-12);
}

}  // namespace
}  // namespace tessera

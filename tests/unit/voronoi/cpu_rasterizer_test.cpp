// The reference backend against a plain double-precision search.
#include "tessera/voronoi/cpu_rasterizer.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "label_maps.h"
#include "tessera/base/portable_math.h"

namespace tessera {
namespace {

constexpr double kTolerance = 1e-3;  // of distances: single precision
constexpr double kNowhere = std::numeric_limits<double>::infinity();

struct Canvas {
  cv::Mat1b zones;
  Metric metric = Metric::kFrustum;
  double reach = 1e4;
};

double distance_to(const Site& site, double x, double y, Metric metric) {
  if (metric == Metric::kFrustum) return SiteDistance(site, metric).at(x, y).distance;
  const double dx = x - site.x, dy = y - site.y, c = std::cos(site.angle), s = std::sin(site.angle);
  return std::max(std::fabs(c * dx + s * dy) / site.extent_u, std::fabs(c * dy - s * dx) / site.extent_v);
}

// Of the site with this label at the pixel's centre; infinite for kUnlabelled and for sites of other zones.
double distance_of_label(const Canvas& canvas, const Sites& sites, int label, int x, int y) {
  if (label == kUnlabelled || sites[label].zone != canvas.zones(y, x)) return kNowhere;
  return distance_to(sites[label], x + 0.5, y + 0.5, canvas.metric);
}

LabelMap label_with(Rasterizer& rasterizer, const Canvas& canvas, const Sites& sites) {
  LabelMap labels;
  EXPECT_TRUE(rasterizer.begin(canvas.zones, canvas.metric, canvas.reach));
  EXPECT_TRUE(rasterizer.label(sites, labels));
  EXPECT_EQ(labels.size(), canvas.zones.size());
  return labels;
}

LabelMap label(const Canvas& canvas, const Sites& sites) { return label_with(*make_cpu_rasterizer(), canvas, sites); }

// Every label is a nearest site's, but for differences that single precision does not see.
void expect_nearest(const Canvas& canvas, const Sites& sites, const LabelMap& labels) {
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      double least = canvas.reach;
      for (int i = 0; i < static_cast<int>(sites.size()); ++i)
        least = std::min(least, distance_of_label(canvas, sites, i, x, y));
      const int got = labels(y, x);
      ASSERT_GE(got, kUnlabelled);
      ASSERT_LT(got, static_cast<int>(sites.size()));
      const double distance = got == kUnlabelled ? canvas.reach : distance_of_label(canvas, sites, got, x, y);
      ASSERT_LE(distance, least + kTolerance) << "label " << got << " at " << x << ", " << y << " of "
                                              << labels.size() << ", " << sites.size() << " sites";
    }
  }
}

// Some lie outside the canvas; zones are those of the canvas.
Sites random_sites(const Canvas& canvas, int count, double extent, Rng& rng) {
  Sites sites(count);
  for (Site& site : sites) {
    site.x = snap_position(rng.uniform(-4, canvas.zones.cols + 4));
    site.y = snap_position(rng.uniform(-4, canvas.zones.rows + 4));
    site.angle = snap_angle(rng.uniform(-7, 7));
    const double least = canvas.metric == Metric::kChebyshev ? 0.3 * extent : 0;
    site.extent_u = static_cast<float>(rng.uniform(least, extent));
    site.extent_v = static_cast<float>(rng.uniform(least, extent));
    site.zone = canvas.zones(below(rng, canvas.zones.rows), below(rng, canvas.zones.cols));
  }
  return sites;
}

Site site_at(double x, double y, float extent = 0) {
  Site site;
  site.x = x;
  site.y = y;
  site.extent_u = site.extent_v = extent;
  return site;
}

const cv::Size kSizes[] = {{1, 1}, {1, 37}, {41, 1}, {7, 5}, {16, 8}, {17, 9}, {100, 70}};
constexpr Metric kMetrics[] = {Metric::kFrustum, Metric::kChebyshev};

// Calls visit(canvas, sites) for canvases of all sizes and metrics, dense and sparse sites, large and small reach.
template <class Visit>
void for_random_cases(int seeds, const Visit& visit) {
  for (int seed = 0; seed < seeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kSites);
    for (const cv::Size& size : kSizes) {
      for (const Metric metric : kMetrics) {
        Canvas canvas{random_zones(size, 1 + seed % 5, rng), metric, 1e4};
        const double extent = rng.uniform(0.5, 6);
        if (seed % 3 == 1) canvas.reach = metric == Metric::kFrustum ? rng.uniform(0, 12) : rng.uniform(0.2, 3);
        const int most = std::max(2, size.area() / 30);
        visit(canvas, random_sites(canvas, seed % 4 == 0 ? 1 + below(rng, 6) : 1 + below(rng, most), extent, rng));
      }
    }
  }
}

TEST(CpuRasterizer, LabelsTheNearestSiteOfThePixelsZone) {
  for_random_cases(
      40, [](const Canvas& canvas, const Sites& sites) { expect_nearest(canvas, sites, label(canvas, sites)); });
}

TEST(CpuRasterizer, OneRasterizerServesManyCanvases) {
  const auto rasterizer = make_cpu_rasterizer();
  for_random_cases(5, [&](const Canvas& canvas, const Sites& sites) {
    EXPECT_TRUE(same_labels(label_with(*rasterizer, canvas, sites), label(canvas, sites)));
  });
}

TEST(CpuRasterizer, FewSitesOnALargeCanvas) {
  for (const Metric metric : kMetrics) {
    for (int seed = 0; seed < 6; ++seed) {
      Rng rng(static_cast<std::uint64_t>(seed), RngPurpose::kSites);
      const Canvas canvas{random_zones({500, 300}, 1 + seed % 2, rng), metric, 1e5};
      const Sites sites = random_sites(canvas, 1 + seed, 3, rng);
      expect_nearest(canvas, sites, label(canvas, sites));
    }
  }
}

TEST(CpuRasterizer, CrowdedHereSparseThere) {
  for (const Metric metric : kMetrics) {
    Rng rng(14, RngPurpose::kSites);
    const Canvas canvas{random_zones({210, 90}, 2, rng), metric, 1e4};
    Sites sites = random_sites(canvas, 400, 2, rng);
    for (Site& site : sites) site.x = snap_position(site.x / 4);
    const Sites few = random_sites(canvas, 4, 2, rng);
    sites.insert(sites.end(), few.begin(), few.end());
    expect_nearest(canvas, sites, label(canvas, sites));
  }
}

TEST(CpuRasterizer, SitesFarOutsideTheCanvas) {
  for (const Metric metric : kMetrics) {
    const Canvas canvas{cv::Mat1b(30, 40, static_cast<unsigned char>(0)), metric, 1e5};
    const Sites sites = {site_at(-500, 10, 2), site_at(700, -300, 2), site_at(20, 900, 3), site_at(-60, -70, 1)};
    expect_nearest(canvas, sites, label(canvas, sites));
  }
}

TEST(CpuRasterizer, AllSitesInOneSpot) {
  Rng rng(8, RngPurpose::kSites);
  for (const Metric metric : kMetrics) {
    const Canvas canvas{cv::Mat1b(50, 90, static_cast<unsigned char>(0)), metric, 1e5};
    Sites sites = random_sites(canvas, 60, 4, rng);
    for (Site& site : sites) {
      site.x = 70.25;
      site.y = 12.5;
    }
    expect_nearest(canvas, sites, label(canvas, sites));
  }
}

TEST(CpuRasterizer, VeryUnequalExtents) {
  Rng rng(9, RngPurpose::kSites);
  for (const Metric metric : kMetrics) {
    const Canvas canvas{cv::Mat1b(64, 64, static_cast<unsigned char>(0)), metric, 1e5};
    Sites sites = random_sites(canvas, 40, 2, rng);
    for (std::size_t i = 0; i < sites.size(); i += 8) {
      sites[i].extent_u = 60;
      sites[i].extent_v = 4;
    }
    expect_nearest(canvas, sites, label(canvas, sites));
  }
}

TEST(CpuRasterizer, OfIdenticalSitesTheFirstWins) {
  for (const Metric metric : kMetrics) {
    Rng rng(10, RngPurpose::kSites);
    const Canvas canvas{random_zones({60, 40}, 2, rng), metric, 1e4};
    Sites sites = random_sites(canvas, 30, 4, rng);
    const LabelMap once = label(canvas, sites);
    const Sites copy = sites;
    sites.insert(sites.end(), copy.begin(), copy.end());
    EXPECT_TRUE(same_labels(label(canvas, sites), once));
  }
}

// All distances are exact in single precision here, so equal ones are equal.
TEST(CpuRasterizer, OnASymmetricLatticeTheLowerIndexWins) {
  Rng rng(11, RngPurpose::kSites);
  for (const Metric metric : kMetrics) {
    for (int round = 0; round < 8; ++round) {
      Sites sites;
      for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) sites.push_back(site_at(4.5 + 8 * x, 4.5 + 8 * y, 2));
      for (std::size_t i = sites.size() - 1; i > 0; --i)
        std::swap(sites[i], sites[below(rng, static_cast<int>(i) + 1)]);
      const Canvas canvas{cv::Mat1b(41, 57, static_cast<unsigned char>(0)), metric, 1e4};
      const LabelMap labels = label(canvas, sites);
      int ties = 0;
      for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
          int expected = 0, equal = 0;
          for (int i = 0; i < static_cast<int>(sites.size()); ++i) {
            const double d = distance_of_label(canvas, sites, i, x, y);
            const double best = distance_of_label(canvas, sites, expected, x, y);
            equal = d < best ? 1 : equal + (d == best);
            if (d < best) expected = i;
          }
          ties += equal > 1;
          ASSERT_EQ(labels(y, x), expected) << x << ", " << y;
        }
      }
      ASSERT_GT(ties, 100);
    }
  }
}

TEST(CpuRasterizer, OutOfReachNothingIsLabelled) {
  const Canvas canvas{cv::Mat1b(40, 60, static_cast<unsigned char>(0)), Metric::kFrustum, 7};
  const LabelMap labels = label(canvas, {site_at(10.5, 10.5, 2), site_at(50.5, 30.5, 0)});
  EXPECT_EQ(labels(10, 10), 0);
  EXPECT_EQ(labels(30, 50), 1);
  EXPECT_EQ(labels(30, 56), 1);            // 6 px off
  EXPECT_EQ(labels(30, 58), kUnlabelled);  // 8 px off
  EXPECT_EQ(labels(10, 18), 0);            // 8 px off, 6 px off its border
  EXPECT_EQ(labels(35, 5), kUnlabelled);
}

TEST(CpuRasterizer, ZonesWithoutSitesStayUnlabelled) {
  for (const Metric metric : kMetrics) {
    Rng rng(12, RngPurpose::kSites);
    const Canvas canvas{random_zones({50, 40}, 4, rng), metric, 1e4};
    Sites sites = random_sites(canvas, 30, 3, rng);
    for (Site& site : sites) site.zone = site.zone == 2 ? 1 : site.zone;
    const LabelMap labels = label(canvas, sites);
    EXPECT_EQ(cv::countNonZero((canvas.zones == 2) & (labels != kUnlabelled)), 0);
    EXPECT_EQ(cv::countNonZero((canvas.zones == 1) & (labels == kUnlabelled)), 0);
  }
}

TEST(CpuRasterizer, WithoutSitesNothingIsLabelled) {
  for (const Metric metric : kMetrics) {
    for (const cv::Size& size : kSizes) {
      const Canvas canvas{cv::Mat1b(size, static_cast<unsigned char>(1)), metric, 100};
      const LabelMap labels = label(canvas, {});
      for (const int l : labels) ASSERT_EQ(l, kUnlabelled);
    }
  }
}

TEST(CpuRasterizer, CanvasMayBePartOfALargerPicture) {
  Rng rng(13, RngPurpose::kSites);
  const cv::Mat1b large = random_zones({80, 80}, 3, rng);
  const Canvas part{large(cv::Rect(11, 7, 37, 23)), Metric::kFrustum, 1e4};
  const Sites sites = random_sites(part, 20, 3, rng);
  expect_nearest(part, sites, label(part, sites));
}

TEST(CpuRasterizer, SameLabelsForAnyNumberOfThreads) {
  const int threads = cv::getNumThreads();
  for_random_cases(6, [](const Canvas& canvas, const Sites& sites) {
    cv::setNumThreads(1);
    const LabelMap one = label(canvas, sites);
    for (const int n : {2, 4}) {
      cv::setNumThreads(n);
      ASSERT_TRUE(same_labels(label(canvas, sites), one)) << n << " threads";
    }
  });
  cv::setNumThreads(threads);
}

TEST(CpuRasterizer, SameLabelsForEveryInstructionSet) {
  for_random_cases(6, [](const Canvas& canvas, const Sites& sites) {
    const LabelMap best = label(canvas, sites);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      ASSERT_TRUE(same_labels(label(canvas, sites), best)) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
  });
}

}  // namespace
}  // namespace tessera

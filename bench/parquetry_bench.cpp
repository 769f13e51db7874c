// Matching on one thread: how the time for a patch grows with the panel's pixels, the rotations and the patches, as
// an exponent. What is built once for all patches is measured with them. How a panel is used up; seams between 900
// pieces, and their curves; a grid of 40 x 40 cells that follows a picture, and a step of its relaxation.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tessera/base/rng.h"
#include "tessera/parquetry/features.h"
#include "tessera/parquetry/morphed_patches.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/run.h"
#include "tessera/parquetry/seam_curves.h"
#include "tessera/parquetry/widen.h"

namespace tessera {
namespace {

// Boards of five woods side by side, with grain.
cv::Mat3b boards(int width, int height) {
  Rng rng(1, RngPurpose::kNoise);
  cv::Mat3b picture(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int wood = 5 * x / width;
      const double grain = 12 * std::sin(0.05 * x + 0.9 * y + 3 * std::sin(0.011 * x)) + rng.uniform(-12, 12);
      const double level = 50 + 40 * wood + grain;
      picture(y, x) = cv::Vec3b(cv::saturate_cast<std::uint8_t>(level), cv::saturate_cast<std::uint8_t>(0.8 * level),
                                cv::saturate_cast<std::uint8_t>(0.6 * level));
    }
  return picture;
}

cv::Mat3b waves(int side) {
  cv::Mat3b picture(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double u = static_cast<double>(x) / side, v = static_cast<double>(y) / side;
      const double level = 128 + 70 * std::sin(9 * u + 5 * v * v) + 40 * std::sin(31 * u * v);
      picture(y, x) = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(level));
    }
  return picture;
}

void match(benchmark::State& state, double megapixels, int rotations, int patches_across) {
  cv::setNumThreads(1);
  const int width = static_cast<int>(1000 * std::sqrt(megapixels * 10 / 7));
  parquetry::Panel panel;
  panel.scan = boards(width, width * 7 / 10);
  panel.mask = cv::Mat1b(panel.scan.size(), 255);
  panel.mm_per_px = 14.0 / 48;
  parquetry::Params params;
  params.rotations = rotations;
  parquetry::Request request;
  request.targets = {waves(48 * patches_across)};
  request.patches = parquetry::grid_patches(request.targets[0].size(), params, panel.mm_per_px);
  for (auto _ : state) benchmark::DoNotOptimize(parquetry::run({panel}, request, params, {}));
  state.SetComplexityN(state.range(0));
  state.counters["s/patch"] =
      benchmark::Counter(static_cast<double>(request.patches.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Google Benchmark fits the exponent: the BigO rows.
void panel_pixels(benchmark::State& state) { match(state, 0.1 * static_cast<double>(state.range(0)), 15, 6); }
BENCHMARK(panel_pixels)->Arg(7)->Arg(14)->Arg(28)->Unit(benchmark::kSecond)->Iterations(1)->Complexity();

void rotations(benchmark::State& state) { match(state, 1.4, static_cast<int>(state.range(0)), 6); }
BENCHMARK(rotations)->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kSecond)->Iterations(1)->Complexity();

void patches(benchmark::State& state) {
  match(state, 2.8, 15, static_cast<int>(std::lround(std::sqrt(static_cast<double>(state.range(0))))));
}
BENCHMARK(patches)->Arg(49)->Arg(100)->Arg(196)->Unit(benchmark::kSecond)->Iterations(1)->Complexity();

// 4.2: the same target again and again from one panel. What a pixel of the last copy costs, and how many of its 36
// patches have no wood left.
void copies(benchmark::State& state) {
  parquetry::Panel panel;
  panel.scan = boards(1000, 700);
  panel.mask = cv::Mat1b(panel.scan.size(), 255);
  panel.mm_per_px = 14.0 / 48;
  parquetry::Params params;
  parquetry::Request request;
  const int last = static_cast<int>(state.range(0)) - 1;
  for (int copy = 0; copy <= last; ++copy) {
    request.targets.push_back(waves(48 * 6));
    for (parquetry::Patch& patch : parquetry::grid_patches(request.targets[0].size(), params, panel.mm_per_px, copy))
      request.patches.push_back(std::move(patch));
  }
  double cost = 0, pixels = 0, missing = 0;
  for (auto _ : state) {
    const auto output = parquetry::run({panel}, request, params, {});
    for (const parquetry::Placement& placement : output->placements) {
      const parquetry::Patch& patch = output->patches[static_cast<std::size_t>(placement.patch)];
      if (patch.target != last) continue;
      missing += placement.panel < 0;
      cost += static_cast<double>(placement.cost);
      pixels += placement.panel < 0 ? 0 : patch.box.area();
    }
  }
  state.counters["cost/px"] = pixels > 0 ? cost / pixels : 0;
  state.counters["missing"] = missing;
}
BENCHMARK(copies)->DenseRange(1, 5)->Unit(benchmark::kSecond)->Iterations(1);

// 30 x 30 pieces that overlap by a quarter, at 150 dpi.
parquetry::Reconstruction pieces_900() {
  constexpr int kSide = 83, kAcross = 30, kGrowth = 10;
  const auto features = [&](const cv::Mat3b& picture) {
    return parquetry::features_of(picture, parquetry::Params());
  };
  parquetry::Reconstruction made;
  for (int k = 0; k <= kAcross; ++k) made.grid.columns.push_back(kSide * k);
  made.grid.rows = made.grid.columns;
  made.target = features(waves(kSide * kAcross));
  const cv::Mat wood = features(boards(2000, 1400));
  Rng rng(2, RngPurpose::kNoise);
  for (int row = 0; row < kAcross; ++row)
    for (int column = 0; column < kAcross; ++column) {
      const cv::Rect box = made.grid.around(column, row, kGrowth);
      const cv::Point at(static_cast<int>(rng.uniform(0, wood.cols - box.width)),
                         static_cast<int>(rng.uniform(0, wood.rows - box.height)));
      made.pieces.push_back({box, wood(cv::Rect(at, box.size())).clone(), {}});
    }
  return made;
}

constexpr parquetry::SeamLimits kLimits{8, 2.95, 4.4};
constexpr double kWidth = 30, kError = 0.59;  // px: 5 mm, 0.1 mm

void seams(benchmark::State& state) {
  cv::setNumThreads(1);
  const parquetry::Reconstruction made = pieces_900();
  for (auto _ : state) {
    parquetry::Seams found = find_seams(made, kLimits);
    widen(made, kLimits.stray, kWidth, found);
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(seams)->Unit(benchmark::kSecond);

void seam_curves(benchmark::State& state) {
  cv::setNumThreads(1);
  const parquetry::Reconstruction made = pieces_900();
  const parquetry::Seams found = find_seams(made, kLimits);
  for (auto _ : state) benchmark::DoNotOptimize(network_of(made.grid, found, kError, Joints::kG1));
}
BENCHMARK(seam_curves)->Unit(benchmark::kSecond);

// Waves in five levels: contours everywhere.
cv::Mat3b contours(int side) {
  cv::Mat3b picture = waves(side);
  for (cv::Vec3b& pixel : picture) pixel = cv::Vec3b::all(static_cast<std::uint8_t>(pixel[0] / 51 * 51));
  return picture;
}

constexpr double kMmPerPx = 0.254;  // 100 dpi

parquetry::Params morphed_40() {
  parquetry::Params params;
  params.grid = parquetry::GridKind::kMorphed;
  params.patch_mm = 40 * kMmPerPx;
  return params;
}

void morphed_patches_40(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat3b target = contours(1600);
  for (auto _ : state) benchmark::DoNotOptimize(parquetry::morphed_patches(target, morphed_40(), kMmPerPx));
}
BENCHMARK(morphed_patches_40)->Unit(benchmark::kSecond);

void morphing_step_40(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat3b target = contours(1600);
  const parquetry::EdgePicture edges = parquetry::edge_picture_of(target, morphed_40(), kMmPerPx);
  auto grid = parquetry::morphing_grid_of(target.size(), edges, morphed_40(), kMmPerPx);
  for (auto _ : state) grid->step();
}
BENCHMARK(morphing_step_40)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tessera

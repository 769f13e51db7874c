#include "tessera/voronoi/cpu_rasterizer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/voronoi/cpu_kernel.h"

namespace tessera {
namespace {

// Boxes that cover the canvas as often as kOverdraw says; no distance where caps alone cover more.
NearDistance choose_near(const SiteBins& bins, std::size_t sites, cv::Size size, Metric metric, float reach) {
  constexpr double kOverdraw = 3;
  constexpr float kRounding = 1 + 1.0f / 1024, kMargin = 1.0f / 64;  // distances are rounded
  double sum = 0, products = 0;
  for (std::size_t k = 0; k < sites; ++k) {
    const double x = std::min<double>(bins.box_x[k], size.width), y = std::min<double>(bins.box_y[k], size.height);
    sum += x + y;
    products += x * y;
  }
  const double budget = kOverdraw * size.area() / 4;
  if (metric == Metric::kChebyshev) {
    const float near = std::min(reach, static_cast<float>(std::sqrt(budget / products)));
    return {near, near * kRounding, kMargin};
  }
  const double n = static_cast<double>(sites), root = sum * sum - 4 * n * (products - budget);
  if (root <= sum * sum) return {0, 0, 0};
  const float near = std::min(reach, static_cast<float>((std::sqrt(root) - sum) / (2 * n)));
  return {near, kRounding, near * kRounding + kMargin};
}

class CpuRasterizer : public Rasterizer {
 public:
  std::string_view name() const override { return "cpu"; }

  Result<void> begin(const cv::Mat1b& zones, Metric metric, double reach) override {
    const int rows = tiles(zones.rows, kTileHeight), columns = tiles(zones.cols, kTileWidth);
    cv::copyMakeBorder(zones, zones_, 0, rows * kTileHeight - zones.rows, 0,
                       columns * kTileWidth - zones.cols + kTilePadding, cv::BORDER_REPLICATE);
    mixed_tiles_.create(rows, columns);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const cv::Mat1b tile = zones_(cv::Rect(x * kTileWidth, y * kTileHeight, kTileWidth, kTileHeight));
        mixed_tiles_(y, x) = cv::countNonZero(tile != tile(0, 0)) > 0;
      }
    }
    size_ = zones.size();
    metric_ = metric;
    reach_ = static_cast<float>(reach);
    return {};
  }

  Result<void> label(const Sites& sites, LabelMap& labels) override {
    labels.create(size_);
    bins_.build(sites, size_.width, size_.height);
    const KernelArguments arguments{&bins_,
                                    zones_.ptr(),
                                    static_cast<std::ptrdiff_t>(zones_.step1()),
                                    mixed_tiles_.ptr(),
                                    metric_,
                                    choose_near(bins_, sites.size(), size_, metric_, reach_),
                                    reach_,
                                    labels.ptr<std::int32_t>(),
                                    static_cast<std::ptrdiff_t>(labels.step1()),
                                    size_.width,
                                    size_.height};
    cv::parallel_for_({0, tiles(size_.height, kTileHeight)},
                      [&](const cv::Range& range) { label_tile_rows(arguments, range.start, range.end); });
    return {};
  }

 private:
  static int tiles(int size, int step) { return (size + step - 1) / step; }

  cv::Mat1b zones_, mixed_tiles_;
  cv::Size size_;
  Metric metric_ = Metric::kFrustum;
  float reach_ = 0;
  SiteBins bins_;
};

}  // namespace

std::unique_ptr<Rasterizer> make_cpu_rasterizer() { return std::make_unique<CpuRasterizer>(); }

}  // namespace tessera

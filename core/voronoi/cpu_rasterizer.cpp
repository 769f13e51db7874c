#include "tessera/voronoi/cpu_rasterizer.h"

#include <opencv2/core/utility.hpp>

#include "tessera/voronoi/cpu_kernel.h"

namespace tessera {
namespace {

class CpuRasterizer : public Rasterizer {
 public:
  std::string_view name() const override { return "cpu"; }

  Result<void> begin(const cv::Mat1b& zones, Metric metric, double reach) override {
    const auto missing = [](int size, int step) { return (step - size % step) % step; };
    cv::copyMakeBorder(zones, zones_, 0, missing(zones.rows, kTileHeight), 0, missing(zones.cols, kTileWidth),
                       cv::BORDER_REPLICATE);
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
                                    metric_,
                                    reach_,
                                    labels.ptr<std::int32_t>(),
                                    static_cast<std::ptrdiff_t>(labels.step1()),
                                    size_.width,
                                    size_.height};
    const int rows = (size_.height + kTileHeight - 1) / kTileHeight;
    cv::parallel_for_({0, rows}, [&](const cv::Range& range) { label_tile_rows(arguments, range.start, range.end); });
    return {};
  }

 private:
  cv::Mat1b zones_;
  cv::Size size_;
  Metric metric_ = Metric::kFrustum;
  float reach_ = 0;
  SiteBins bins_;
};

}  // namespace

std::unique_ptr<Rasterizer> make_cpu_rasterizer() { return std::make_unique<CpuRasterizer>(); }

}  // namespace tessera

#include "tessera/voronoi/fallback_rasterizer.h"

#include <cassert>
#include <utility>

namespace tessera {
namespace {

class FallbackRasterizer : public Rasterizer {
 public:
  FallbackRasterizer(std::unique_ptr<Rasterizer> first, std::unique_ptr<Rasterizer> second,
                     std::function<void(const Status&)> on_switch)
      : current_(std::move(first)), second_(std::move(second)), on_switch_(std::move(on_switch)) {
    assert(current_ && second_);
  }

  std::string_view name() const override { return current_->name(); }

  Result<void> begin(const cv::Mat1b& zones, Metric metric, double reach) override {
    zones_ = zones;
    metric_ = metric;
    reach_ = reach;
    auto begun = current_->begin(zones, metric, reach);
    return may_switch(begun) ? switch_over(begun.error()) : begun;
  }

  Result<void> label(const Sites& sites, LabelMap& labels) override {
    auto labelled = current_->label(sites, labels);
    if (!may_switch(labelled)) return labelled;
    return switch_over(labelled.error()).and_then([&] { return current_->label(sites, labels); });
  }

 private:
  bool may_switch(const Result<void>& done) const {
    return !done && done.error().code == StatusCode::kInternal && second_;
  }

  Result<void> switch_over(const Status& reason) {
    if (on_switch_) on_switch_(reason);
    current_ = std::move(second_);
    return current_->begin(zones_, metric_, reach_);
  }

  std::unique_ptr<Rasterizer> current_, second_;  // the second is null once it is the current one
  std::function<void(const Status&)> on_switch_;
  cv::Mat1b zones_;
  Metric metric_ = Metric::kFrustum;
  double reach_ = 0;
};

}  // namespace

std::unique_ptr<Rasterizer> make_fallback_rasterizer(std::unique_ptr<Rasterizer> first,
                                                     std::unique_ptr<Rasterizer> second,
                                                     std::function<void(const Status& reason)> on_switch) {
  return std::make_unique<FallbackRasterizer>(std::move(first), std::move(second), std::move(on_switch));
}

}  // namespace tessera

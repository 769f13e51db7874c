#include "tessera/gpu/site_batch.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera {
namespace {

// No pixel farther than this from the site can get its label.
double influence(const Site& site, Metric metric, double reach) {
  const double half_diagonal = std::hypot(site.extent_u, site.extent_v);
  return metric == Metric::kFrustum ? half_diagonal + reach : half_diagonal * reach;
}

// Distance from the site to the nearest and the farthest point of the rectangle.
struct Span {
  double nearest, farthest;
};

Span span(const Site& site, const cv::Rect& box) {
  const double left = box.x - site.x, right = site.x - box.br().x;
  const double above = box.y - site.y, below = site.y - box.br().y;
  return {std::hypot(std::max({left, right, 0.0}), std::max({above, below, 0.0})),
          std::hypot(std::max(-left, -right), std::max(-above, -below))};
}

SiteRecord record_of(const Site& site, std::size_t index, const cv::Rect& tile) {
  const SinCos turn = sin_cos(site.angle);
  return {static_cast<float>(site.x - tile.x),
          static_cast<float>(site.y - tile.y),
          static_cast<float>(turn.cos),
          static_cast<float>(turn.sin),
          site.extent_u,
          site.extent_v,
          static_cast<float>(site.zone),
          static_cast<float>(index)};
}

}  // namespace

SiteBatch gather_sites(const Sites& sites, Metric metric, double reach, const cv::Rect& tile) {
  SiteBatch batch;
  double farthest = 0;
  double pixel = metric == Metric::kFrustum ? 1 : 0;  // the largest distance that a step of one pixel adds
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Site& site = sites[i];
    const double shorter = std::min(site.extent_u, site.extent_v);
    if (metric == Metric::kChebyshev && shorter <= 0) continue;  // nothing is within its reach
    const Span distance = span(site, tile);
    if (distance.nearest > influence(site, metric, reach)) continue;
    farthest = std::max(farthest, distance.farthest);
    if (metric == Metric::kFrustum) {
      batch.lowest = std::min(batch.lowest, -shorter);
    } else {
      pixel = std::max(pixel, 1 / shorter);
    }
    batch.records.push_back(record_of(site, i, tile));
  }
  batch.reach = std::min(reach, farthest * pixel) + pixel;

  std::stable_sort(batch.records.begin(), batch.records.end(),
                   [](const SiteRecord& a, const SiteRecord& b) { return a.zone < b.zone; });
  for (int slot = 0; slot < static_cast<int>(batch.records.size()); ++slot) {
    const auto zone = static_cast<std::uint8_t>(batch.records[slot].zone);
    if (batch.runs.empty() || batch.runs.back().zone != zone) batch.runs.push_back({zone, slot, 0});
    ++batch.runs.back().count;
  }
  return batch;
}

}  // namespace tessera

#include "tessera/voronoi/site_bins.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "tessera/base/portable_math.h"

namespace tessera {
namespace {
constexpr std::size_t kPadding = 16;  // entries a vector may read past the end
}

int SiteBins::bin_of(double position, int count) const {
  return std::clamp(static_cast<int>(std::floor(position / bin)), 0, count - 1);
}

void SiteBins::build(const Sites& sites, int width, int height) {
  // About one site a bin, and never more bins than pixels allow.
  const double mean_area =
      static_cast<double>(width) * height / static_cast<double>(std::max<std::size_t>(1, sites.size()));
  bin = std::max(4.0, std::sqrt(mean_area));
  columns = std::max(1, static_cast<int>(std::ceil(width / bin)));
  rows = std::max(1, static_cast<int>(std::ceil(height / bin)));

  place.resize(sites.size());
  first.assign(static_cast<std::size_t>(columns) * rows + 1, 0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    place[i] = bin_of(sites[i].y, rows) * columns + bin_of(sites[i].x, columns);
    ++first[place[i] + 1];
  }
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];

  const std::size_t size = sites.size() + kPadding;
  for (auto* array : {&cosine, &sine, &extent_u, &extent_v, &box_x, &box_y}) array->resize(size, 1);
  for (auto* array : {&x, &y, &zone, &id}) array->resize(size, -1);
  std::vector<int> next(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    place[i] = next[place[i]]++;
    id[place[i]] = static_cast<std::int32_t>(i);
  }
  for (std::size_t k = 0; k < sites.size(); ++k) put(k, sites[id[k]]);
  box_max = extent_max = 0;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    box_max = std::max({box_max, box_x[k], box_y[k]});
    extent_max = std::max(extent_max, std::sqrt(extent_u[k] * extent_u[k] + extent_v[k] * extent_v[k]));
  }
}

void SiteBins::put(std::size_t k, const Site& site) {
  const SinCos turn = sin_cos(site.angle);
  x[k] = cvRound(site.x * kSubpixels);
  y[k] = cvRound(site.y * kSubpixels);
  cosine[k] = static_cast<float>(turn.cos);
  sine[k] = static_cast<float>(turn.sin);
  extent_u[k] = site.extent_u;
  extent_v[k] = site.extent_v;
  box_x[k] = std::abs(cosine[k]) * site.extent_u + std::abs(sine[k]) * site.extent_v;
  box_y[k] = std::abs(sine[k]) * site.extent_u + std::abs(cosine[k]) * site.extent_v;
  zone[k] = site.zone;
}

}  // namespace tessera

#include "tessera/voronoi/site_bins.h"

#include <algorithm>
#include <cmath>

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
  const double mean_area = static_cast<double>(width) * height / static_cast<double>(std::max<std::size_t>(1, sites.size()));
  bin = std::max(4.0, std::sqrt(mean_area));
  columns = std::max(1, static_cast<int>(std::ceil(width / bin)));
  rows = std::max(1, static_cast<int>(std::ceil(height / bin)));

  const auto index_of = [&](const Site& s) { return bin_of(s.y, rows) * columns + bin_of(s.x, columns); };
  first.assign(static_cast<std::size_t>(columns) * rows + 1, 0);
  for (const Site& s : sites) ++first[index_of(s) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];

  const std::size_t size = sites.size() + kPadding;
  for (auto* array : {&cosine, &sine, &extent_u, &extent_v}) array->assign(size, 1);
  for (auto* array : {&x, &y, &zone, &id}) array->assign(size, -1);
  extent_max = 0;
  std::vector<int> next(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Site& s = sites[i];
    const int k = next[index_of(s)]++;
    const SinCos turn = sin_cos(s.angle);
    x[k] = static_cast<std::int32_t>(std::lround(s.x * kSubpixels));
    y[k] = static_cast<std::int32_t>(std::lround(s.y * kSubpixels));
    cosine[k] = static_cast<float>(turn.cos);
    sine[k] = static_cast<float>(turn.sin);
    extent_u[k] = s.extent_u;
    extent_v[k] = s.extent_v;
    zone[k] = s.zone;
    id[k] = static_cast<std::int32_t>(i);
    extent_max = std::max(extent_max, std::sqrt(s.extent_u * s.extent_u + s.extent_v * s.extent_v));
  }
}

}  // namespace tessera

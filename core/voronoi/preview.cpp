#include "tessera/voronoi/preview.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tessera {
namespace {

int sampled(int length, int step) { return (length + step - 1) / step; }

int pixel_step(const cv::Size& size, int max_pixels) {
  int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(size.area()) / max_pixels)));
  while (static_cast<double>(sampled(size.width, step)) * sampled(size.height, step) > max_pixels) ++step;
  return step;
}

cv::Mat1b draw_cells(const Iteration& iteration, int step) {
  const LabelMap& labels = iteration.labels;
  const auto zone_of = [&](int label) {
    return label == kUnlabelled ? 0 : iteration.sites[label].zone & kPreviewZone;
  };
  cv::Mat1b cells(sampled(labels.rows, step), sampled(labels.cols, step));
  for (int j = 0; j < cells.rows; ++j) {
    const int* row = labels[j * step];
    const int* below = labels[std::min(j * step + step, labels.rows - 1)];
    for (int i = 0; i < cells.cols; ++i) {
      const int x = i * step, own = row[x];
      int pixel = zone_of(own);
      for (const int next : {row[std::min(x + step, labels.cols - 1)], below[x]}) {
        if (next == own) continue;
        pixel |= kPreviewCellBorder;
        if (zone_of(next) != zone_of(own)) pixel |= kPreviewZoneBorder;
      }
      cells(j, i) = static_cast<std::uint8_t>(pixel);
    }
  }
  return cells;
}

}  // namespace

Preview make_preview(const Iteration& iteration, int max_pixels, int max_sites) {
  assert(max_pixels >= 1 && max_sites >= 1);
  Preview preview;
  preview.cells = draw_cells(iteration, pixel_step(iteration.labels.size(), max_pixels));
  const std::size_t step = std::max<std::size_t>(1, (iteration.sites.size() + max_sites - 1) / max_sites);
  for (std::size_t i = 0; i < iteration.sites.size(); i += step) {
    const Site& site = iteration.sites[i];
    preview.sites.insert(preview.sites.end(),
                         {static_cast<float>(site.x / iteration.scale), static_cast<float>(site.y / iteration.scale),
                          static_cast<float>(site.angle), static_cast<float>(site.zone)});
  }
  return preview;
}

}  // namespace tessera

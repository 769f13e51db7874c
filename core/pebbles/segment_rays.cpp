#include "tessera/pebbles/segment_rays.h"

#include <optional>
#include <vector>

#include "tessera/geometry/scan.h"
#include "tessera/pebbles/distinct.h"
#include "tessera/pebbles/level_edges.h"
#include "tessera/pebbles/neighbours.h"
#include "tessera/pebbles/slice.h"

namespace tessera::pebbles {
namespace {

constexpr int kSpacing = 5;  // px between samples: w/5 x h/5 of them

// The free samples, row by row.
std::vector<cv::Point> samples_of(const Mask& mask, cv::Size size) {
  std::vector<cv::Point> samples;
  for (int y = kSpacing / 2; y < size.height; y += kSpacing)
    for (int x = kSpacing / 2; x < size.width; x += kSpacing)
      if (mask.free({x, y})) samples.emplace_back(x, y);
  return samples;
}

// Gives the slice's pixels that no other has; returns them.
std::vector<cv::Point> paint(const Pebble& slice, int label, cv::Mat1i& labels) {
  std::vector<cv::Point> pixels;
  each_run(outline(slice), labels.cols, labels.rows, [&](int y, int begin, int end) {
    for (int x = begin; x < end; ++x) {
      if (labels(y, x) != 0) continue;
      labels(y, x) = label;
      pixels.emplace_back(x, y);
    }
  });
  return pixels;
}

}  // namespace

Result<cv::Mat1i> slices_of(const cv::Mat1b& edges, const RunContext& context) {
  constexpr std::size_t kPatience = 256;  // samples between two looks at the context
  Mask mask(edges);
  cv::Mat1i labels(edges.size(), 0);
  int count = 0;
  const std::vector<cv::Point> samples = samples_of(mask, edges.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k % kPatience == 0) {
      if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
      context.progress(0.1 + 0.4 * static_cast<double>(k) / static_cast<double>(samples.size()));
    }
    if (!mask.free(samples[k])) continue;  // enclosed by now
    if (const std::optional<Pebble> slice = find_slice(mask, samples[k])) mask.fill(paint(*slice, ++count, labels));
  }
  keep_largest_parts(labels, count);
  return labels;
}

Result<cv::Mat1i> segment_by_rays(const cv::Mat3b& photo, const Params& params, const RunContext& context) {
  const cv::Mat1b edges = level_edges(photo, params.median_radius, params.edge_ratio);
  Result<cv::Mat1i> labels = slices_of(edges, context);
  if (labels) drop_indistinct(photo, params, *labels);
  return labels;
}

}  // namespace tessera::pebbles

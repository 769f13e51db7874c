#include "tessera/pebbles/segment_rays.h"

#include <optional>
#include <vector>

#include "tessera/geometry/scan.h"
#include "tessera/image/lab.h"
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

// Floods the slice from its origin, up to the curve and to the edges within, so that a pebble that the curve runs
// across is left for samples of its own; returns the pixels.
std::vector<cv::Point> flood(const Slice& slice, int label, const Mask& mask, cv::Mat1i& labels) {
  constexpr int kEnclosed = -1;
  std::vector<cv::Point> enclosed, pixels;
  each_run(outline(slice.shape), labels.cols, labels.rows, [&](int y, int begin, int end) {
    for (int x = begin; x < end; ++x) {
      if (labels(y, x) != 0) continue;
      labels(y, x) = kEnclosed;
      enclosed.emplace_back(x, y);
    }
  });
  const auto take = [&](int y, int x) {
    if (labels(y, x) != kEnclosed) return;
    labels(y, x) = label;
    pixels.emplace_back(x, y);
  };
  take(slice.origin.y, slice.origin.x);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    if (const cv::Point p = pixels[k]; mask.free(p)) each_neighbour(labels, p.y, p.x, take);
  for (const cv::Point p : enclosed)
    if (labels(p) == kEnclosed) labels(p) = 0;
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
    if (const std::optional<Slice> slice = find_slice(mask, samples[k]))
      mask.fill(flood(*slice, ++count, mask, labels));
  }
  return labels;
}

Result<cv::Mat1i> segment_by_rays(const cv::Mat3b& photo, const Params& params, const RunContext& context) {
  const cv::Mat1b edges = level_edges(photo, params.median_radius, params.edge_ratio);
  Result<cv::Mat1i> labels = slices_of(edges, context);
  if (labels) drop_indistinct(lab_of(photo), params, *labels);
  return labels;
}

}  // namespace tessera::pebbles

// Small panels, targets and patches made in code, and matching done the slow way.
#pragma once

#include <optional>
#include <vector>

#include "tessera/base/rng.h"
#include "tessera/parquetry/assign.h"
#include "tessera/parquetry/features.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/spacing.h"

namespace tessera::parquetry {

// Smooth blotches under noise: wood for what matters here.
inline cv::Mat3b blotches(Rng& rng, cv::Size size, int noise = 30) {
  cv::Mat3b picture(size);
  const double period = rng.uniform(8, 40), way = rng.uniform(-1, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int wave = static_cast<int>((x + way * y) / period) % 5;
      const int grey = 60 + 25 * std::abs(wave) + static_cast<int>(rng.uniform(0, noise));
      picture(y, x) = cv::Vec3b(grey, grey * 3 / 4, grey / 2);
    }
  return picture;
}

// All wood but for some rectangles.
inline cv::Mat1b mask_with_holes(Rng& rng, cv::Size size, int holes) {
  cv::Mat1b mask(size, 255);
  for (int i = 0; i < holes; ++i) {
    const cv::Rect hole(static_cast<int>(rng.uniform(0, size.width)), static_cast<int>(rng.uniform(0, size.height)),
                        static_cast<int>(rng.uniform(1, 8)), static_cast<int>(rng.uniform(1, 8)));
    mask(hole & cv::Rect({0, 0}, size)).setTo(0);
  }
  return mask;
}

inline Panel board(Rng& rng, cv::Size size, int holes, double mm_per_px = 1) {
  Panel panel;
  panel.name = "board";
  panel.scan = blotches(rng, size);
  panel.mask = mask_with_holes(rng, size, holes);
  panel.mm_per_px = mm_per_px;
  return panel;
}

// A convex or a notched outline on the pixels of a box.
inline Patch odd_patch(Rng& rng, cv::Rect box) {
  Patch patch;
  patch.box = box;
  const double l = box.x, t = box.y, r = box.x + box.width, b = box.y + box.height;
  const double in = rng.uniform(0.1, 0.4) * box.width, down = rng.uniform(0.1, 0.4) * box.height;
  patch.outline.outer = {{l + in, t}, {r, t + down}, {r - in, b}, {l, b - down}};
  if (rng.uniform() < 0.5)
    patch.outline.outer = {{l, t}, {r, t}, {r, t + 2 * down}, {l + in, t + 2 * down}, {l + in, b}, {l, b}};
  patch.mask = cv::Mat1b(box.size(), 0);
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x)
      if (contains(patch.outline.outer, {box.x + x + 0.5, box.y + y + 0.5})) patch.mask(y, x) = 255;
  return patch;
}

// What matching and cutting promise, asked of each place one by one.
class SlowWood {
 public:
  SlowWood(const std::vector<Panel>& panels, const Params& params)
      : panels_(panels), clearance_(params.clearance_mm / panels[0].mm_per_px) {}

  bool fits(int panel, const Ring& cut) const {
    const cv::Mat1b& mask = panels_[panel].mask;
    for (const Point p : cut)
      if (p.x < clearance_ || p.y < clearance_ || p.x > mask.cols - clearance_ || p.y > mask.rows - clearance_)
        return false;
    for (int y = 0; y < mask.rows; ++y)
      for (int x = 0; x < mask.cols; ++x)
        if (mask(y, x) == 0 && distance(cut, {x + 0.5, y + 0.5}) < clearance_ + std::sqrt(0.5)) return false;
    for (const auto& [where, other] : cuts)
      if (where == panel && !are_apart(cut, other, clearance_)) return false;
    return true;
  }

  std::vector<std::pair<int, Ring>> cuts;

 private:
  const std::vector<Panel>& panels_;
  double clearance_;
};

// Eq. 4, pixel by pixel, over the turned features.
inline std::int64_t slow_cost(const Patch& patch, const cv::Mat& target, const Rows& frame, cv::Point at) {
  std::int64_t sum = 0;
  const int channels = target.channels();
  for (int y = 0; y < patch.box.height; ++y)
    for (int x = 0; x < patch.box.width; ++x)
      for (int c = 0; patch.mask(y, x) != 0 && c < channels; ++c) {
        const int off =
            target.ptr(patch.box.y + y)[(patch.box.x + x) * channels + c] - frame.at(at.y + y, at.x + x)[c];
        sum += off * off;
      }
  return sum;
}

struct SlowMatcher {
  SlowMatcher(const std::vector<Panel>& panels, const cv::Mat3b& target, const Params& params)
      : views(views_of(panels, params)), half_kerf(0.5 * params.kerf_mm / panels[0].mm_per_px) {
    Histogram wood{};
    for (const Panel& panel : panels)
      for (int y = 0; y < panel.mask.rows; ++y)
        for (int x = 0; x < panel.mask.cols; ++x)
          if (panel.mask(y, x) != 0) ++wood[intensity_of(panel.scan)(y, x)];
    const Tones tones = matched_tones(histogram_of(intensity_of(target), {}), wood, params.weight_histogram);
    features = features_of(target, params, &tones);
    for (const View& view : views)
      frames.push_back(view.turn.turned(features_of(panels[view.panel].scan, params), view.turn.size().width));
  }

  std::optional<Match> best(const Patch& patch, const SlowWood& wood) const {
    std::optional<Match> best;
    const Shape shape = shape_of(patch, half_kerf);
    for (int v = 0; v < static_cast<int>(views.size()); ++v) {
      const cv::Size size = views[v].turn.size();
      for (int y = 0; y + patch.box.height <= size.height; ++y)
        for (int x = 0; x + patch.box.width <= size.width; ++x) {
          const Match match{slow_cost(patch, features, frames[v], {x, y}), v, {x, y}};
          if (best && !(match < *best)) continue;
          if (wood.fits(views[v].panel, cut_at(shape, views[v].turn, views[v].rotation, {x, y}).outer)) best = match;
        }
    }
    return best;
  }

  std::vector<View> views;
  double half_kerf;
  cv::Mat features;
  std::vector<Rows> frames;
};

}  // namespace tessera::parquetry

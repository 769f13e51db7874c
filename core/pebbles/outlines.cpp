#include "tessera/pebbles/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/scan.h"

namespace tessera::pebbles {
namespace {

constexpr double kStep = 0.5;      // px along a ray
constexpr int kBridged = 4;        // steps: notches that are narrower are no border
constexpr int kMedian = 5;         // rays
constexpr double kThinnest = 0.1;  // no radius is less than this share of the mean

using Radii = std::array<double, kDirections>;

const std::array<SinCos, kDirections>& directions() {
  static const auto all = [] {
    std::array<SinCos, kDirections> turns{};
    for (int k = 0; k < kDirections; ++k) turns[k] = sin_cos(2 * kPi * k / kDirections);
    return turns;
  }();
  return all;
}

double border_along(const cv::Mat1i& labels, int label, Point centre, SinCos direction) {
  double last = 0;
  int missed = 0;
  for (double t = 0; missed <= kBridged; t += kStep) {
    const int x = static_cast<int>(std::floor(centre.x + t * direction.cos)),
              y = static_cast<int>(std::floor(centre.y + t * direction.sin));
    if (x < 0 || y < 0 || x >= labels.cols || y >= labels.rows) break;
    const bool own = labels(y, x) == label;
    missed = own ? 0 : missed + 1;
    if (own) last = t;
  }
  return last + kStep / 2;
}

// The median of five rays against strays, then [1 2 1] / 4 twice.
std::vector<double> evened(const Radii& radii) {
  Radii calm{};
  const auto at = [](int k) { return (k + kDirections) % kDirections; };
  double mean = 0;
  for (int k = 0; k < kDirections; ++k) {
    std::array<double, kMedian> window{};
    for (int d = 0; d < kMedian; ++d) window[d] = radii[at(k + d - kMedian / 2)];
    std::nth_element(window.begin(), window.begin() + kMedian / 2, window.end());
    calm[k] = window[kMedian / 2];
    mean += calm[k] / kDirections;
  }
  for (int round = 0; round < 2; ++round) {
    const Radii before = calm;
    for (int k = 0; k < kDirections; ++k) calm[k] = 0.25 * (before[at(k - 1)] + before[at(k + 1)]) + 0.5 * before[k];
  }
  for (double& r : calm) r = std::max(r, kThinnest * mean);
  return {calm.begin(), calm.end()};
}

struct Mass {
  std::int64_t count = 0, x = 0, y = 0;
};

std::vector<Mass> masses(const cv::Mat1i& labels) {
  std::vector<Mass> out;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels(y, x);
      if (label <= 0) continue;
      if (static_cast<int>(out.size()) <= label) out.resize(label + 1);
      ++out[label].count, out[label].x += x, out[label].y += y;
    }
  return out;
}

// How far out a point lies: 0 at the centre, 1 on the outline.
double share_of_radius(const Pebble& pebble, Point p) {
  const Point d = p - pebble.centre;
  const auto count = static_cast<double>(pebble.radii.size());
  const double turn = atan2_portable(d.y, d.x) / (2 * kPi) * count;
  const double place = turn < 0 ? turn + count : turn;
  const auto k = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(k);
  const double r =
      (1 - part) * pebble.radii[k % pebble.radii.size()] + part * pebble.radii[(k + 1) % pebble.radii.size()];
  return length(d) / r;
}

}  // namespace

std::vector<Pebble> fit_outlines(const cv::Mat1i& labels) {
  const std::vector<Mass> all = masses(labels);
  std::vector<Pebble> pebbles;
  for (int label = 1; label < static_cast<int>(all.size()); ++label) {
    const Mass& mass = all[label];
    if (mass.count == 0) continue;
    const double n = static_cast<double>(mass.count);
    pebbles.push_back({label, {static_cast<double>(mass.x) / n + 0.5, static_cast<double>(mass.y) / n + 0.5}, {}, n});
  }
  cv::parallel_for_({0, static_cast<int>(pebbles.size())}, [&](const cv::Range& range) {
    for (int p = range.start; p < range.end; ++p) {
      Radii radii{};
      for (int k = 0; k < kDirections; ++k)
        radii[k] = border_along(labels, pebbles[p].id, pebbles[p].centre, directions()[k]);
      pebbles[p].radii = evened(radii);
    }
  });
  return pebbles;
}

void enlarge(double factor, std::vector<Pebble>& pebbles) {
  for (Pebble& pebble : pebbles) {
    pebble.centre = factor * pebble.centre;
    pebble.area_px *= factor * factor;
    for (double& r : pebble.radii) r *= factor;
  }
}

cv::Mat1i paint_labels(std::vector<Pebble>& pebbles, cv::Size size) {
  cv::Mat1i labels(size, 0);
  std::vector<int> index_of(1, -1);  // of a label
  for (int p = 0; p < static_cast<int>(pebbles.size()); ++p) {
    const int own = pebbles[p].id;
    index_of.resize(std::max<std::size_t>(index_of.size(), own + 1), -1);
    index_of[own] = p;
    each_run(outline(pebbles[p]), size.width, size.height, [&](int y, int begin, int end) {
      for (int x = begin; x < end; ++x) {
        int& label = labels(y, x);
        const Point centre{x + 0.5, y + 0.5};
        if (label == 0 || share_of_radius(pebbles[p], centre) < share_of_radius(pebbles[index_of[label]], centre))
          label = own;
      }
    });
  }
  for (Pebble& pebble : pebbles) pebble.area_px = 0;
  for (const int label : labels)
    if (label > 0) pebbles[index_of[label]].area_px += 1;
  return labels;
}

}  // namespace tessera::pebbles

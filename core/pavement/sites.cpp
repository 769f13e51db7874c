#include "tessera/pavement/sites.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera::pavement {
namespace {

// Stones a pixel.
double density(double half_width, double half_side) {
  return 1 / (4 * half_width * half_length(half_width, half_side));
}

constexpr double kBlockSide = 2;  // in sides of a stone

// The pixels of a square block in random order.
std::vector<cv::Point> shuffled_pixels(int side, Rng& rng) {
  std::vector<cv::Point> pixels;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) pixels.push_back({x, y});
  for (std::size_t i = pixels.size() - 1; i > 0; --i) std::swap(pixels[i], pixels[rng.bits() % (i + 1)]);
  return pixels;
}

// Collects pixels of one zone until they hold a stone; any of them, weighted by density, may be its site.
struct Stratum {
  double filled = 0;
  double next = 0;  // fill at which the site is placed
  bool placed = false;
};

}  // namespace

double half_side_of(cv::Size source, const Params& params) {
  if (params.sites == 0) return params.half_side;
  return 0.5 * std::sqrt(source.width * (static_cast<double>(source.height) / params.sites));
}

Sites first_sites(const Fields& fields, const Params& params, std::uint64_t seed) {
  Rng positions(seed, RngPurpose::kSites), shapes(seed, RngPurpose::kShapes);
  const double h = fields.half_side;
  const cv::Mat1b& zones = fields.zones.map;
  const double plain = density(h, h);
  std::array<Stratum, 256> strata;
  for (Stratum& s : strata) s.next = positions.uniform();
  Sites sites;

  const auto visit = [&](int x, int y) {
    Stratum& s = strata[zones(y, x)];
    const bool near_edge = fields.distance(y, x) < h;
    s.filled += near_edge ? density(fields.half_width_at(x + 0.5, y + 0.5, h), h) : plain;
    // A thin line's pixels may hold more than one stone each.
    while (s.filled >= 1 || (!s.placed && s.filled > s.next)) {
      if (!s.placed && s.filled > s.next) {
        Site site;
        site.x = snap_position(x + positions.uniform());
        site.y = snap_position(y + positions.uniform());
        site.zone = zones(y, x);
        const double stretch = shapes.uniform(params.stretch_min, params.stretch_max);  // s_x
        site.extent_u = static_cast<float>(params.cap_scale * h * stretch);
        site.extent_v = static_cast<float>(params.cap_scale * h);
        sites.push_back(site);
        s.placed = true;
      }
      if (s.filled >= 1) {
        s.filled -= 1;
        s.next = positions.uniform();
        s.placed = false;
      }
    }
  };
  // Blocks of some stones' size, so that no part of the picture gets too few; within a block at random, so that no
  // rows of blocks show. What is left of a block's last stone goes to the next in a serpentine.
  const int block = std::max(1, static_cast<int>(std::lround(kBlockSide * 2 * h)));
  const std::vector<cv::Point> order = shuffled_pixels(block, positions);
  for (int by = 0, row = 0; by < zones.rows; by += block, ++row) {
    const int columns = (zones.cols + block - 1) / block;
    for (int k = 0; k < columns; ++k) {
      const int bx = (row % 2 == 0 ? k : columns - 1 - k) * block;
      const std::size_t start = positions.bits() % order.size();
      for (std::size_t i = 0; i < order.size(); ++i) {
        const cv::Point p = order[(start + i) % order.size()] + cv::Point(bx, by);
        if (p.x < zones.cols && p.y < zones.rows) visit(p.x, p.y);
      }
    }
  }
  return sites;
}

}  // namespace tessera::pavement

#include "tessera/pavement/sites.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tessera/base/portable_math.h"

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

}  // namespace

double half_side_of(cv::Size source, const Params& params) {
  if (params.sites == 0) return params.half_side;
  return 0.5 * std::sqrt(source.width * (static_cast<double>(source.height) / params.sites));
}

int sites_for(cv::Size source, double half_side) {
  return static_cast<int>(std::lround(source.width * (source.height / (4 * half_side * half_side))));
}

Sower::Sower(cv::Size picture, double half_side, const Params& params, std::uint64_t seed)
    : picture_(picture),
      half_side_(half_side),
      params_(params),
      positions_(seed, RngPurpose::kSites),
      shapes_(seed, RngPurpose::kShapes),
      plain_(density(half_side, half_side)),
      // Blocks of some stones' size, so that no part of the picture gets too few; within a block at random, so that
      // no rows of blocks show. What is left of a block's last stone goes to the next in a serpentine.
      block_(std::max(1, static_cast<int>(std::lround(kBlockSide * 2 * half_side)))) {
  for (Stratum& s : strata_) s.next = positions_.uniform();
  order_ = shuffled_pixels(block_, positions_);
}

void Sower::sow(const Fields& fields, int end, Sites& sites) {
  const int columns = (picture_.width + block_ - 1) / block_;
  for (; next_row_ < std::min(end, picture_.height); next_row_ += block_) {
    const bool to_the_right = next_row_ / block_ % 2 == 0;
    for (int k = 0; k < columns; ++k) {
      const int bx = (to_the_right ? k : columns - 1 - k) * block_;
      const std::size_t start = positions_.bits() % order_.size();
      for (std::size_t i = 0; i < order_.size(); ++i) {
        const cv::Point p = order_[(start + i) % order_.size()] + cv::Point(bx, next_row_);
        if (p.x < picture_.width && p.y < picture_.height) visit(fields, p, sites);
      }
    }
  }
}

void Sower::visit(const Fields& fields, cv::Point p, Sites& sites) {
  const double h = half_side_;
  const int y = p.y - fields.origin.y;
  const std::uint8_t zone = fields.zones.map(y, p.x);
  Stratum& s = strata_[zone];
  const bool near_edge = fields.distance(y, p.x) < h;
  s.filled += near_edge ? density(fields.half_width_at(p.x + 0.5, y + 0.5, h), h) : plain_;
  // A thin line's pixels may hold more than one stone each.
  while (s.filled >= 1 || (!s.placed && s.filled > s.next)) {
    if (!s.placed && s.filled > s.next) {
      Site site;
      site.x = snap_position(p.x + positions_.uniform());
      site.y = snap_position(p.y + positions_.uniform());
      site.zone = zone;
      const double stretch = shapes_.uniform(params_.stretch_min, params_.stretch_max);  // s_x
      site.extent_u = static_cast<float>(params_.cap_scale * h * stretch);
      site.extent_v = static_cast<float>(params_.cap_scale * h);
      sites.push_back(site);
      s.placed = true;
    }
    if (s.filled >= 1) {
      s.filled -= 1;
      s.next = positions_.uniform();
      s.placed = false;
    }
  }
}

Sites first_sites(const Fields& fields, const Params& params, std::uint64_t seed) {
  Sites sites;
  Sower sower(fields.zones.map.size(), fields.half_side, params, seed);
  sower.sow(fields, fields.zones.map.rows, sites);
  return sites;
}

}  // namespace tessera::pavement

#include "tessera/formats/coverage.h"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

// Keeps the part of the ring where distance(p) >= 0 (Sutherland and Hodgman).
template <class Distance>
void clip(Ring& ring, Distance&& distance) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i == 0 ? ring.size() - 1 : i - 1], b = ring[i];
    const double da = distance(a), db = distance(b);
    if ((da < 0) != (db < 0)) kept.push_back(a + da / (da - db) * (b - a));
    if (db >= 0) kept.push_back(b);
  }
  ring = std::move(kept);
}

}  // namespace

void Coverage::deposit(const Polygon& polygon, double scale) {
  set_ring(polygon.outer, scale, picture_);
  set_box();
  cells_.assign(stride() * static_cast<std::size_t>(box_.bottom - box_.top), 0.0F);
  deposit_ring(1);
  for (const Ring& hole : polygon.holes) {
    set_ring(hole, scale, box_);
    deposit_ring(-1);
  }
}

void Coverage::set_ring(const Ring& ring, double scale, const Box& limits) {
  ring_.clear();
  for (const Point p : ring) ring_.push_back(scale * p);
  const double left = limits.left, top = limits.top, right = limits.right, bottom = limits.bottom;
  const bool within = std::all_of(ring_.begin(), ring_.end(), [&](Point p) {
    return left <= p.x && p.x <= right && top <= p.y && p.y <= bottom;
  });
  if (within) return;
  clip(ring_, [=](Point p) { return p.x - left; });
  clip(ring_, [=](Point p) { return right - p.x; });
  clip(ring_, [=](Point p) { return p.y - top; });
  clip(ring_, [=](Point p) { return bottom - p.y; });
  for (Point& p : ring_) p = {std::clamp(p.x, left, right), std::clamp(p.y, top, bottom)};  // after rounding
}

void Coverage::set_box() {
  box_ = {};
  if (ring_.empty()) return;
  const auto [left, right] =
      std::minmax_element(ring_.begin(), ring_.end(), [](Point a, Point b) { return a.x < b.x; });
  const auto [top, bottom] =
      std::minmax_element(ring_.begin(), ring_.end(), [](Point a, Point b) { return a.y < b.y; });
  box_ = {static_cast<int>(std::floor(left->x)), static_cast<int>(std::floor(top->y)),
          static_cast<int>(std::ceil(right->x)), static_cast<int>(std::ceil(bottom->y))};
}

void Coverage::deposit_ring(float sense) {
  if (signed_area(ring_) > 0) sense = -sense;  // a ring of positive area climbs, y down, on its left
  const Point corner{static_cast<double>(box_.left), static_cast<double>(box_.top)};
  for (std::size_t i = 0; i < ring_.size(); ++i)
    deposit_side(ring_[i == 0 ? ring_.size() - 1 : i - 1] - corner, ring_[i] - corner, sense);
}

void Coverage::deposit_side(Point a, Point b, float sense) {
  if (a.y == b.y) return;
  if (a.y > b.y) {
    std::swap(a, b);
    sense = -sense;
  }
  const double slope = (b.x - a.x) / (b.y - a.y);
  const int end_row = static_cast<int>(std::ceil(b.y));
  for (int row = static_cast<int>(a.y); row < end_row; ++row) {
    float* cells = &cells_[static_cast<std::size_t>(row) * stride()];
    const double y0 = std::max<double>(row, a.y), y1 = std::min<double>(row + 1, b.y);
    const double limit = box_.right - box_.left;
    const double xa = std::clamp(a.x + (y0 - a.y) * slope, 0.0, limit);
    const double xb = std::clamp(a.x + (y1 - a.y) * slope, 0.0, limit);
    const double x0 = std::min(xa, xb), x1 = std::max(xa, xb);
    const int end_column = std::max(static_cast<int>(x0) + 1, static_cast<int>(std::ceil(x1)));
    for (int column = static_cast<int>(x0); column < end_column; ++column) {
      const double c0 = std::max<double>(column, x0), c1 = std::min<double>(column + 1, x1);
      const double part = x1 > x0 ? (c1 - c0) / (x1 - x0) : 1;
      const auto climb = sense * static_cast<float>((y1 - y0) * part);
      const auto right_of = static_cast<float>((c0 + c1) / 2 - column);
      cells[column] += climb * (1 - right_of);
      cells[column + 1] += climb * right_of;
    }
  }
}

}  // namespace tessera

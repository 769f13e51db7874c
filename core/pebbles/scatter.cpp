#include "tessera/pebbles/scatter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera::pebbles {
namespace {

constexpr std::size_t kPrototypes = 24;
constexpr double kLeastScale = 0.85, kLargestScale = 1.15;
constexpr double kCoverage = 0.4;  // of the field by the stones' circles; discs thrown at random get to 0.54
constexpr int kTries = 64;

// Circles by place, to ask how much room there is.
class Circles {
 public:
  Circles(Point size, double largest)
      : size_(size),
        cell_(std::max(2 * largest, std::max(size.x, size.y) / 2048)),
        columns_(static_cast<int>(size.x / cell_) + 1),
        rows_(static_cast<int>(size.y / cell_) + 1),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  // Distance from a circle to the nearest one, < 0 where they overlap, or anything > 0 where none is near.
  double clearance(Point place, double radius) const {
    double least = cell_;
    const int column = column_of(place), row = row_of(place);
    for (int j = std::max(0, row - 1); j <= std::min(rows_ - 1, row + 1); ++j)
      for (int i = std::max(0, column - 1); i <= std::min(columns_ - 1, column + 1); ++i)
        for (const auto& [other, other_radius] : cells_[index(i, j)])
          least = std::min(least, length(place - other) - radius - other_radius);
    return least;
  }

  void add(Point place, double radius) { cells_[index(column_of(place), row_of(place))].emplace_back(place, radius); }

 private:
  int column_of(Point p) const { return std::clamp(static_cast<int>((p.x + size_.x / 2) / cell_), 0, columns_ - 1); }
  int row_of(Point p) const { return std::clamp(static_cast<int>((p.y + size_.y / 2) / cell_), 0, rows_ - 1); }
  std::size_t index(int column, int row) const { return static_cast<std::size_t>(row) * columns_ + column; }

  Point size_;
  double cell_;
  int columns_, rows_;
  std::vector<std::vector<std::pair<Point, double>>> cells_;
};

std::vector<Throw> draw_stones(std::size_t kinds, int count, Rng& rng) {
  std::vector<Throw> throws(static_cast<std::size_t>(count));
  for (Throw& t : throws) {
    t.stone = std::min(kinds - 1, static_cast<std::size_t>(rng.uniform() * static_cast<double>(kinds)));
    t.turn = rng.uniform(0, 2 * kPi);
    t.scale = rng.uniform(kLeastScale, kLargestScale);
  }
  return throws;
}

}  // namespace

std::vector<Pebble> prototypes(const std::vector<Pebble>& pebbles, std::uint64_t seed) {
  if (pebbles.size() <= kPrototypes) return pebbles;
  Rng rng(seed, RngPurpose::kPrototypes);
  std::vector<std::size_t> order(pebbles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = 0; i < kPrototypes; ++i) {
    const auto left = static_cast<double>(order.size() - i);
    std::swap(order[i], order[std::min(order.size() - 1, i + static_cast<std::size_t>(rng.uniform() * left))]);
  }
  std::sort(order.begin(), order.begin() + kPrototypes);
  std::vector<Pebble> chosen;
  for (std::size_t i = 0; i < kPrototypes; ++i) chosen.push_back(pebbles[order[i]]);
  return chosen;
}

Strewn strew(const std::vector<double>& radii, int count, Point size, std::uint64_t seed) {
  Strewn strewn{size, {}};
  if (radii.empty() || count < 1) return strewn;
  Rng rng(seed, RngPurpose::kScatter);
  strewn.throws = draw_stones(radii.size(), count, rng);
  const auto radius = [&](const Throw& t) { return radii[t.stone] * t.scale; };

  // The largest first: small ones find room between them.
  std::stable_sort(strewn.throws.begin(), strewn.throws.end(),
                   [&](const Throw& a, const Throw& b) { return radius(a) > radius(b); });
  double circles = 0;
  for (const Throw& t : strewn.throws) circles += kPi * radius(t) * radius(t);
  strewn.size = std::max(1.0, std::sqrt(circles / kCoverage / (size.x * size.y))) * size;

  Circles placed(strewn.size, radius(strewn.throws.front()));
  for (Throw& t : strewn.throws) {
    double most = 0;
    for (int i = 0; i < kTries; ++i) {
      const Point place{(rng.uniform() - 0.5) * strewn.size.x, (rng.uniform() - 0.5) * strewn.size.y};
      const double room = placed.clearance(place, radius(t));
      if (i == 0 || room > most) {
        most = room;
        t.place = place;
      }
      if (room >= 0) break;
    }
    placed.add(t.place, radius(t));
  }
  return strewn;
}

}  // namespace tessera::pebbles

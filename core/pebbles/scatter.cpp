#include "tessera/pebbles/scatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"
#include "tessera/points/point_grid.h"
#include "tessera/points/processes.h"

namespace tessera::pebbles {
namespace {

constexpr double kLeastScale = 0.85, kLargestScale = 1.15;
constexpr int kTries = 64;
// Where the stones have found no room: more places to choose from, on a field that is larger.
constexpr double kMorePlaces = 1.3, kLarger = 1.04;

// What a way to strew begins with.
struct Start {
  double coverage;  // of the field by the stones' circles; discs thrown at random get to 0.54
  double places;    // to a stone
};

Start start_of(Strewing strewing) {
  switch (strewing) {
    case Strewing::kBlueNoise: return {0.35, 1.3};  // few to choose from, or they lie at random
    case Strewing::kInhibition: return {0.3, 2};
    case Strewing::kCluster: return {0.2, 4};
    case Strewing::kPoisson: break;
  }
  return {0.4, 6};
}

// About so many points.
std::vector<Point> points_of(Strewing strewing, const Window& window, double stones, double places, Rng& rng) {
  const double intensity = stones * places / window.area();
  switch (strewing) {
    case Strewing::kBlueNoise:
      return blue_noise_points(window, std::sqrt(0.7 / intensity), rng);  // Bridson's discs cover 0.7 pi / 4
    case Strewing::kInhibition: {
      // Of 1.6 points those stay of which there are 1 - exp(-1.6) = 0.8: nearly as close as the process gets.
      const double d = std::sqrt(0.8 / (4 * kPi * intensity));
      return matern2_points(window, 2 * intensity, d, rng);
    }
    case Strewing::kCluster: {
      constexpr double kFamily = 12, kSpread = 0.3;  // stones to a group; of the way between groups
      const double groups = stones / kFamily / window.area();
      return cluster_points(window, groups, kFamily * places, kSpread / std::sqrt(groups), rng);
    }
    case Strewing::kPoisson: break;
  }
  return poisson_points(window, intensity, rng);
}

// Places for stones, and how large a circle there is room for at each.
class Places {
 public:
  // `largest`: the largest radius that will be placed.
  Places(const Window& window, std::vector<Point> points, double largest)
      : points_(std::move(points)),
        grid_(points_, window, 2 * largest),
        room_(points_.size(), std::numeric_limits<double>::infinity()),
        open_(points_.size()) {
    std::iota(open_.begin(), open_.end(), std::size_t{0});
  }

  // A place at random with room for that circle, which it takes; none where a few tries have found none. Circles come
  // the largest first.
  std::optional<Point> take(double radius, double smallest, Rng& rng) {
    for (int t = 0; t < kTries && !open_.empty(); ++t) {
      const auto pick = std::min(open_.size() - 1, static_cast<std::size_t>(rng.uniform() * open_.size()));
      const Point place = points_[open_[pick]];
      const double room = room_[open_[pick]];
      if (room < radius && room >= smallest) continue;
      open_[pick] = open_.back();
      open_.pop_back();
      if (room < radius) continue;
      cover(place, radius);
      return place;
    }
    return std::nullopt;
  }

 private:
  void cover(Point centre, double radius) {
    grid_.each_near(centre, 2 * radius, [&](int k, Point place) {
      room_[k] = std::min(room_[k], length(place - centre) - radius);
      return true;
    });
  }

  std::vector<Point> points_;
  PointGrid grid_;
  std::vector<double> room_;       // up to the nearest circle
  std::vector<std::size_t> open_;  // those where a stone may go yet
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

std::vector<Pebble> prototypes(const std::vector<Pebble>& pebbles, int count, std::uint64_t seed) {
  const auto chosen_count = static_cast<std::size_t>(count);
  if (pebbles.size() <= chosen_count) return pebbles;
  Rng rng(seed, RngPurpose::kPrototypes);
  std::vector<std::size_t> order(pebbles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = 0; i < chosen_count; ++i) {
    const auto left = static_cast<double>(order.size() - i);
    std::swap(order[i], order[std::min(order.size() - 1, i + static_cast<std::size_t>(rng.uniform() * left))]);
  }
  std::sort(order.begin(), order.begin() + count);
  std::vector<Pebble> chosen;
  for (std::size_t i = 0; i < chosen_count; ++i) chosen.push_back(pebbles[order[i]]);
  return chosen;
}

Strewn strew(const std::vector<double>& radii, int count, Point size, Strewing strewing, std::uint64_t seed) {
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
  const double largest = radius(strewn.throws.front()), smallest = radius(strewn.throws.back());

  auto [coverage, places_each] = start_of(strewing);
  double larger = std::max({1.0, std::sqrt(circles / coverage / (size.x * size.y)),
                            2 * largest / std::min(size.x, size.y)});  // no stone meets itself at the other side
  for (bool all_lie = false; !all_lie; places_each *= kMorePlaces, larger *= kLarger) {
    strewn.size = larger * size;
    const Window window{-0.5 * strewn.size, 0.5 * strewn.size, true};
    Places places(window, points_of(strewing, window, count, places_each, rng), largest);
    all_lie = std::all_of(strewn.throws.begin(), strewn.throws.end(), [&](Throw& t) {
      const std::optional<Point> place = places.take(radius(t), smallest, rng);
      if (place) t.place = *place;
      return place.has_value();
    });
  }
  return strewn;
}

}  // namespace tessera::pebbles

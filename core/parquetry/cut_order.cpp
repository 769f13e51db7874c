#include "tessera/parquetry/cut_order.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tessera::parquetry {
namespace {

void uncross(const std::vector<Point>& places, std::vector<std::size_t>& tour) {
  constexpr int kRounds = 30;
  constexpr double kWorth = 1e-6;
  const auto way = [&](std::size_t i, std::size_t k) { return length(places[tour[i]] - places[tour[k]]); };
  bool better = true;
  for (int round = 0; better && round < kRounds; ++round) {
    better = false;
    for (std::size_t i = 1; i + 1 < tour.size(); ++i)
      for (std::size_t k = i + 1; k < tour.size(); ++k) {
        const double after = k + 1 < tour.size() ? way(k, k + 1) - way(i, k + 1) : 0;
        if (way(i - 1, i) - way(i - 1, k) + after <= kWorth) continue;
        std::reverse(tour.begin() + static_cast<std::ptrdiff_t>(i),
                     tour.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        better = true;
      }
  }
}

}  // namespace

std::vector<std::size_t> short_tour(const std::vector<Point>& places) {
  std::vector<std::size_t> left(places.size()), tour;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  Point at{0, 0};
  while (!left.empty()) {
    const auto next = std::min_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
      return length(places[a] - at) < length(places[b] - at);
    });
    at = places[*next];
    tour.push_back(*next);
    left.erase(next);
  }
  uncross(places, tour);
  return tour;
}

Ring begun_near(const Ring& ring, Point from) {
  const auto first = std::min_element(ring.begin(), ring.end(),
                                      [&](Point a, Point b) { return length(a - from) < length(b - from); });
  Ring begun(first, ring.end());
  begun.insert(begun.end(), ring.begin(), first);
  return begun;
}

}  // namespace tessera::parquetry

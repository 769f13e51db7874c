#include "tessera/mosaic/push_apart.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/point.h"

namespace tessera::mosaic {
namespace {

constexpr int kRounds = 30;

struct Tile {
  Point centre, u, v;  // half sides
};

std::vector<Tile> tiles_of(const Sites& sites, double delta) {
  std::vector<Tile> tiles;
  for (const Site& site : sites) {
    const SinCos turn = sin_cos(site.angle);
    tiles.push_back({{site.x, site.y},
                     (delta * site.extent_u) * Point{turn.cos, turn.sin},
                     (delta * site.extent_v) * Point{-turn.sin, turn.cos}});
  }
  return tiles;
}

double radius(const Tile& tile) { return length(tile.u + tile.v); }

// A side of the picture in parts, no shorter than a bin where they wrap.
struct Bins {
  Bins(int length, double bin, bool does_wrap)
      : count(static_cast<int>(length / bin) + 1), size(bin), wraps(does_wrap) {
    if (!wraps) return;
    count = std::max(1, static_cast<int>(length / bin));
    size = static_cast<double>(length) / count;
  }

  int of(double v) const { return std::clamp(static_cast<int>(v / size), 0, count - 1); }
  // A bin and those beside it, each once.
  std::vector<int> around(int i) const {
    std::vector<int> list;
    for (int k = i - 1; k <= i + 1; ++k) {
      const int there = wraps ? (k + count) % count : k;
      if (there >= 0 && there < count && std::find(list.begin(), list.end(), there) == list.end())
        list.push_back(there);
    }
    return list;
  }

  int count;
  double size;
  bool wraps;
};

// Pairs that may come to overlap: no farther apart than their half diagonals and a little.
std::vector<std::pair<int, int>> close_pairs(const std::vector<Tile>& tiles, const Torus& torus) {
  constexpr double kLittle = 1.2;
  double widest = 1;
  for (const Tile& tile : tiles) widest = std::max(widest, radius(tile));
  const double bin = 2 * kLittle * widest;
  const Bins across(torus.period.width, bin, torus.wraps()), down(torus.period.height, bin, torus.wraps());
  std::vector<std::vector<int>> bins(static_cast<std::size_t>(across.count) * down.count);
  std::vector<std::pair<int, int>> pairs;
  for (int k = 0; k < static_cast<int>(tiles.size()); ++k) {
    const Tile& tile = tiles[k];
    const int i = across.of(tile.centre.x - torus.margin), j = down.of(tile.centre.y - torus.margin);
    for (const int y : down.around(j))
      for (const int x : across.around(i))
        for (const int other : bins[static_cast<std::size_t>(y) * across.count + x])
          if (length(torus.shortest(tiles[other].centre - tile.centre)) <
              kLittle * (radius(tiles[other]) + radius(tile)))
            pairs.push_back({other, k});
    bins[static_cast<std::size_t>(j) * across.count + i].push_back(k);
  }
  return pairs;
}

// The shortest way for `b` out of `a`, along a side of either (separating axes); (0, 0) where they do not overlap.
Point way_out(const Tile& a, const Tile& b, const Torus& torus) {
  const Point between = torus.shortest(b.centre - a.centre);
  double least = 1e30;
  Point way{0, 0};
  for (const Point side : {a.u, a.v, b.u, b.v}) {
    const Point axis = (1 / length(side)) * side;
    const double reach =
        std::fabs(dot(a.u, axis)) + std::fabs(dot(a.v, axis)) + std::fabs(dot(b.u, axis)) + std::fabs(dot(b.v, axis));
    const double apart = dot(between, axis), depth = reach - std::fabs(apart);
    if (depth <= 0) return {0, 0};
    if (depth < least) least = depth, way = (apart < 0 ? -depth : depth) * axis;
  }
  return way;
}

}  // namespace

void push_apart(Sites& sites, double delta, const Torus& torus) {
  std::vector<Tile> tiles = tiles_of(sites, delta);
  const std::vector<std::pair<int, int>> pairs = close_pairs(tiles, torus);
  bool moved = true;
  for (int round = 0; round < kRounds && moved; ++round) {
    moved = false;
    for (const auto& [i, k] : pairs) {
      const Point way = way_out(tiles[i], tiles[k], torus);
      if (way.x == 0 && way.y == 0) continue;
      tiles[i].centre = tiles[i].centre - 0.5 * way;
      tiles[k].centre = tiles[k].centre + 0.5 * way;
      moved = true;
    }
  }
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const cv::Size canvas = torus.canvas();
    sites[i].x = std::clamp<double>(tiles[i].centre.x, 0, canvas.width);
    sites[i].y = std::clamp<double>(tiles[i].centre.y, 0, canvas.height);
  }
}

}  // namespace tessera::mosaic

#include "tessera/mosaic/sites.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/base/rng.h"

namespace tessera::mosaic {
namespace {

constexpr double kCrowded = 0.8;  // of the space a tile has: nearer than this there is no room for another
constexpr int kSnappedRows = 2;   // how many rows keep to whole distances from their edge

// Lays tiles beside tiles.
class Front {
 public:
  Front(const Fields& fields, const Params& params) : fields_(fields), params_(params) {
    float least = std::numeric_limits<float>::max();
    for (const float v : fields.sides) least = std::min(least, v), most_ = std::max(most_, v);
    // Of a rectangle the longer side counts.
    const double stretch = std::sqrt(std::max(params.aspect, 1 / params.aspect));
    narrowness_ = 1 / stretch;
    bin_ = std::max(1.0, 1.0 * least);
    reach_ = static_cast<int>(std::ceil(most_ * stretch / bin_)) + 1;
    columns_ = static_cast<int>(fields.torus.period.width / bin_) + 1;
    rows_ = static_cast<int>(fields.torus.period.height / bin_) + 1;
    bins_.resize(static_cast<std::size_t>(columns_) * rows_);
  }

  Sites run() {
    seed_first_rows();
    grow();
    fill();
    Sites sites;
    for (const Tile& tile : tiles_) sites.push_back(tile.site);
    return sites;
  }

 private:
  // A place that a tile may take. Rows near edges first; within a row those beside a tile before new beginnings; then
  // first come, first served.
  struct Place {
    int row;
    bool beginning;
    std::uint32_t turn;
    float x, y;
    bool operator<(const Place& other) const {
      if (row != other.row) return row > other.row;
      if (beginning != other.beginning) return beginning;
      return turn > other.turn;
    }
  };

  double rows_from_edge(Point p) const { return at(fields_.distance, p.x, p.y) / fields_.side(p.x, p.y); }

  void propose(Point p, bool beginning) {
    p = torus_.wrapped(p);
    if (p.x < 0 || p.y < 0 || p.x > fields_.size.width || p.y > fields_.size.height) return;
    const double away = rows_from_edge(p);
    const int row = static_cast<int>(std::min(away, 1e6));
    if (row < kSnappedRows) p = torus_.wrapped(snapped(p, row + 0.5));
    if (hopeless(p)) return;
    open_.push({row, beginning, turn_++, static_cast<float>(p.x), static_cast<float>(p.y)});
  }

  // Moved to be `wanted` sides away from the next edge, but by half a side at most.
  Point snapped(Point p, double wanted) const {
    const double side = fields_.side(p.x, p.y);
    const double way = std::clamp(wanted * side - at(fields_.distance, p.x, p.y), -0.5 * side, 0.5 * side);
    return fields_.inside(p + way * fields_.uphill(p));
  }

  void seed_first_rows() {
    const int stride = std::max(1, static_cast<int>(bin_ / 3));
    const cv::Rect window = torus_.window();
    for (int y = window.y; y < window.br().y; y += stride)
      for (int x = window.x; x < window.br().x; x += stride) {
        if (fields_.distance(y, x) > 0.7 * most_) continue;
        const Point p{x + 0.5, y + 0.5};
        const double away = rows_from_edge(p);
        if (away > 0.3 && away < 0.7) propose(p, true);
      }
  }

  void grow() {
    while (!open_.empty()) {
      const Place place = open_.top();
      open_.pop();
      if (!lay({place.x, place.y})) continue;
      const Tile& tile = tiles_.back();
      const Point p{tile.site.x, tile.site.y};
      const Point u = (2 * tile.site.extent_u) * Point{tile.turn.cos, tile.turn.sin},
                  v = (2 * tile.site.extent_v) * Point{-tile.turn.sin, tile.turn.cos};
      for (const Point beside : {p + v, p - v, p + u, p - u}) propose(beside, false);
    }
  }

  // Beginnings where nothing lies yet.
  void fill() {
    const double stride = std::max(1.0, bin_ / 2);
    for (int j = 1; j * stride < torus_.period.height; ++j)
      for (int i = 1; i * stride < torus_.period.width; ++i) {
        const double x = torus_.margin + i * stride, y = torus_.margin + j * stride;
        const double half = 0.5 * fields_.side(x, y);
        const Point p{std::clamp(x, std::min(half, 0.5 * fields_.size.width),
                                 std::max(fields_.size.width - half, 0.5 * fields_.size.width)),
                      std::clamp(y, std::min(half, 0.5 * fields_.size.height),
                                 std::max(fields_.size.height - half, 0.5 * fields_.size.height))};
        if (hopeless(p) || !has_room(tile_at(p))) continue;
        propose(p, true);
        grow();
      }
    if (tiles_.empty()) lay({0.5 * fields_.size.width, 0.5 * fields_.size.height});
  }

  struct Tile {
    Site site;
    SinCos turn;
  };

  Tile tile_at(Point p) const {
    Tile tile;
    tile.site.x = snap_position(p.x);
    tile.site.y = snap_position(p.y);
    bring_home(tile.site, torus_);
    turn_and_size(tile.site, fields_, params_);
    tile.turn = sin_cos(tile.site.angle);
    return tile;
  }

  bool lay(Point p) {
    const double margin = torus_.wraps() ? 0 : 0.3 * fields_.side(p.x, p.y);
    const auto leaves = [&](double v, double size) {
      return v < std::min(margin, 0.4 * size) || v > size - std::min(margin, 0.4 * size);
    };
    if (leaves(p.x, fields_.size.width) || leaves(p.y, fields_.size.height) || hopeless(p)) return false;
    const Tile tile = tile_at(p);
    if (!has_room(tile)) return false;
    bins_[bin_of(tile.site)].push_back(static_cast<int>(tiles_.size()));
    tiles_.push_back(tile);
    return true;
  }

  int column_of(double x) const { return std::clamp(static_cast<int>((x - torus_.margin) / bin_), 0, columns_ - 1); }
  int row_of(double y) const { return std::clamp(static_cast<int>((y - torus_.margin) / bin_), 0, rows_ - 1); }
  std::size_t bin_of(const Site& site) const {
    return static_cast<std::size_t>(row_of(site.y)) * columns_ + column_of(site.x);
  }

  // Whether that holds for any tile in the bins up to `reach` around p's.
  template <class Holds>
  bool any_around(Point p, int reach, const Holds& holds) const {
    const int ci = column_of(p.x), cj = row_of(p.y);
    if (torus_.wraps()) return any_around_torus(ci, cj, reach + 1, holds);  // the last bins may be narrow
    for (int j = std::max(0, cj - reach); j <= std::min(rows_ - 1, cj + reach); ++j)
      for (int i = std::max(0, ci - reach); i <= std::min(columns_ - 1, ci + reach); ++i)
        for (const int k : bins_[static_cast<std::size_t>(j) * columns_ + i])
          if (holds(tiles_[k])) return true;
    return false;
  }

  template <class Holds>
  bool any_around_torus(int ci, int cj, int reach, const Holds& holds) const {
    const auto wrapped = [](int i, int n) { return (i % n + n) % n; };
    for (int j = cj - reach; j <= cj + reach; ++j)
      for (int i = ci - reach; i <= ci + reach; ++i)
        for (const int k : bins_[static_cast<std::size_t>(wrapped(j, rows_)) * columns_ + wrapped(i, columns_)])
          if (holds(tiles_[k])) return true;
    return false;
  }

  bool has_room(const Tile& tile) const {
    const Site& site = tile.site;
    // No farther than the two tiles' half diagonals.
    const int reach =
        std::min(reach_, static_cast<int>(std::ceil(3 * std::max(site.extent_u, site.extent_v) / bin_)) + 1);
    return !any_around({site.x, site.y}, reach, [&](const Tile& other) { return crowded(tile, other); });
  }

  // Whether a tile in this place or next to it is so near that there is no room, whichever way both turn. Most places
  // proposed are taken, and need no frame to be turned down.
  bool hopeless(Point p) const {
    const double half = 0.5 * narrowness_ * fields_.side(p.x, p.y);
    return any_around(p, 1, [&](const Tile& tile) {
      const Site& other = tile.site;
      const Point way = torus_.shortest(Point{other.x, other.y} - p);
      const double reach = kCrowded * (half + std::min(other.extent_u, other.extent_v));
      return dot(way, way) < reach * reach;
    });
  }

  // Distance in the frames of both, where 1 is side by side.
  bool crowded(const Tile& a, const Tile& b) const {
    const Point way = torus_.shortest({b.site.x - a.site.x, b.site.y - a.site.y});
    const double u = a.site.extent_u + b.site.extent_u, v = a.site.extent_v + b.site.extent_v;
    const auto apart = [&](const SinCos& turn) {
      return std::max(std::fabs(turn.cos * way.x + turn.sin * way.y) / u,
                      std::fabs(turn.cos * way.y - turn.sin * way.x) / v);
    };
    return 0.5 * (apart(a.turn) + apart(b.turn)) < kCrowded;
  }

  const Fields& fields_;
  const Torus& torus_ = fields_.torus;
  const Params& params_;
  float most_ = 0;         // side of the largest tile
  double narrowness_ = 1;  // a tile's shorter side against that of a square
  double bin_ = 1;
  int reach_ = 1, columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> bins_;
  std::priority_queue<Place> open_;
  std::uint32_t turn_ = 0;
  std::vector<Tile> tiles_;
};

}  // namespace

void turn_and_size(Site& site, const Fields& fields, const Params& params) {
  const double half = 0.5 * fields.side(site.x, site.y), stretch = std::sqrt(params.aspect);
  site.angle = snap_angle(fields.direction.angle(site.x, site.y));
  site.extent_u = static_cast<float>(half / stretch);
  site.extent_v = static_cast<float>(half * stretch);
}

Sites random_sites(const Fields& fields, const Params& params, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kSites);
  float least = std::numeric_limits<float>::max();
  for (const float v : fields.sides) least = std::min(least, v);
  const cv::Rect window = fields.torus.window();
  Sites sites;
  while (static_cast<int>(sites.size()) < params.tiles) {
    Site site;
    site.x = window.x + snap_position(rng.uniform(0, window.width));
    site.y = window.y + snap_position(rng.uniform(0, window.height));
    bring_home(site, fields.torus);
    const double ratio = least / fields.side(site.x, site.y);
    if (rng.uniform() > ratio * ratio) continue;
    turn_and_size(site, fields, params);
    sites.push_back(site);
  }
  return sites;
}

namespace {

// Tiles lie closer than their sides say, or less close: scales the sides until together they cover the picture.
void fit_sides(Sites& sites, Fields& fields, const Params& params) {
  double covered = 0;
  for (const Site& site : sites) covered += 4.0 * site.extent_u * site.extent_v;
  scale_sides(fields,
              std::sqrt(static_cast<double>(fields.torus.period.width) * fields.torus.period.height / covered));
  for (Site& site : sites) turn_and_size(site, fields, params);
}

}  // namespace

Sites rows_of_sites(Fields& fields, const Params& params) {
  constexpr int kTries = 3;
  constexpr double kClose = 0.03;
  Sites sites;
  for (int k = 0; k < kTries; ++k) {
    sites = Front(fields, params).run();
    const double ratio = static_cast<double>(sites.size()) / params.tiles;
    if (std::fabs(ratio - 1) < kClose || k + 1 == kTries) break;
    scale_sides(fields, std::sqrt(ratio));
  }
  fit_sides(sites, fields, params);
  return sites;
}

}  // namespace tessera::mosaic

#include "tessera/mosaic/torus.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace tessera::mosaic {
namespace {

using Corner = std::pair<int, int>;

Point position_of(const Junction& junction) {
  return {static_cast<double>(junction.x), static_cast<double>(junction.y)};
}

Corner wrapped_corner(const Torus& torus, const Junction& junction) {
  const Point p = torus.wrapped(position_of(junction));
  return {static_cast<int>(p.x), static_cast<int>(p.y)};
}

// Which vertex stands for each on the torus, and how far from there it lies.
struct Folding {
  std::vector<int> vertex;
  std::vector<Point> shift;
};

Folding fold_vertices(const Torus& torus, const CellGraph& graph, const Bends& bends,
                      const std::vector<int>& shared) {
  Folding folding;
  std::map<Corner, int> first;
  const auto same = [&](int v) {
    return first.try_emplace(wrapped_corner(torus, graph.junctions[v]), v).first->second;
  };
  const int junctions = static_cast<int>(graph.junctions.size());
  // Those of the window stand for the others, whose surroundings may be cut off.
  for (int v = 0; v < junctions; ++v)
    if (torus.home_shift(position_of(graph.junctions[v])) == Point{0, 0}) same(v);
  for (int v = 0; v < junctions; ++v) {
    folding.vertex.push_back(same(v));
    folding.shift.push_back(position_of(graph.junctions[v]) - position_of(graph.junctions[same(v)]));
  }
  std::vector<int> first_bend;
  int vertices = junctions;
  for (const auto& along : bends) first_bend.push_back(vertices), vertices += static_cast<int>(along.size());
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const Arc &arc = graph.arcs[k], &other = graph.arcs[shared[k]];
    const bool back =
        folding.vertex[arc.from] != folding.vertex[other.from] || arc.direction_from != other.direction_from;
    const Point way =
        position_of(graph.junctions[arc.from]) - position_of(graph.junctions[back ? other.to : other.from]);
    const int n = static_cast<int>(bends[k].size());
    for (int i = 0; i < n; ++i) {
      folding.vertex.push_back(first_bend[shared[k]] + (back ? n - 1 - i : i));
      folding.shift.push_back(way);
    }
  }
  return folding;
}

bool centre_in_window(const Torus& torus, const PlanarMap& map, int cell) {
  Point centre{0, 0};
  for (int slot = map.first[cell]; slot < map.first[cell + 1]; ++slot)
    centre += (1.0 / map.corners(cell)) * map.at(slot);
  return torus.home_shift(centre) == Point{0, 0};
}

}  // namespace

Point Torus::home_shift(Point p) const {
  return {period.width * std::floor((p.x - margin) / period.width),
          period.height * std::floor((p.y - margin) / period.height)};
}

Point Torus::shortest(Point way) const {
  if (!wraps()) return way;
  return {way.x - period.width * std::round(way.x / period.width),
          way.y - period.height * std::round(way.y / period.height)};
}

Ghosts::Ghosts(const Torus& torus, Sites& sites)
    : torus_(torus),
      own_(static_cast<int>(sites.size())),
      reach_x_((torus.margin + torus.period.width - 1) / torus.period.width),
      reach_y_((torus.margin + torus.period.height - 1) / torus.period.height),
      labels_(static_cast<std::size_t>(2 * reach_x_ + 1) * (2 * reach_y_ + 1) * sites.size(), -1) {
  const cv::Size canvas = torus.canvas();
  for (int rows = -reach_y_; rows <= reach_y_; ++rows)
    for (int columns = -reach_x_; columns <= reach_x_; ++columns)
      for (int k = 0; k < own_; ++k) {
        const Copy copy{k, columns, rows};
        if (columns == 0 && rows == 0) {
          labels_[place_of(copy)] = k;
          continue;
        }
        const double x = sites[k].x + columns * torus.period.width, y = sites[k].y + rows * torus.period.height;
        if (x < 0 || y < 0 || x > canvas.width || y > canvas.height) continue;
        labels_[place_of(copy)] = own_ + static_cast<int>(copies_.size());
        copies_.push_back(copy);
      }
  sites.resize(own_ + copies_.size());
  follow(sites);
}

void Ghosts::follow(Sites& sites) const {
  for (std::size_t i = 0; i < copies_.size(); ++i) {
    Site& ghost = sites[own_ + i];
    ghost = sites[copies_[i].site];
    ghost.x += copies_[i].columns * torus_.period.width;
    ghost.y += copies_[i].rows * torus_.period.height;
  }
}

int Ghosts::find(const Copy& copy) const {
  if (std::abs(copy.columns) > reach_x_ || std::abs(copy.rows) > reach_y_) return -1;
  return labels_[place_of(copy)];
}

void Ghosts::wrap(LabelMap& labels) const {
  const cv::Rect window = torus_.window();
  // By how many periods each column and row lies beyond the window.
  const auto periods = [&](int size, int period) {
    std::vector<int> beyond(size);
    for (int i = 0; i < size; ++i) beyond[i] = (i - torus_.margin + size * period) / period - size;
    return beyond;
  };
  const std::vector<int> columns = periods(labels.cols, window.width), rows = periods(labels.rows, window.height);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      if (columns[x] == 0 && rows[y] == 0) continue;
      const int label = labels(y - rows[y] * window.height, x - columns[x] * window.width);
      if (label < 0) continue;
      Copy copy = copy_of(label);
      copy.columns += columns[x];
      copy.rows += rows[y];
      // The sites of pixels at the canvas' border may lie beyond it.
      if (const int there = find(copy); there >= 0) labels(y, x) = there;
    }
}

LabelMap Ghosts::window_of(const LabelMap& labels) const {
  LabelMap window = labels(torus_.window()).clone();
  for (int& label : window)
    if (label >= own_) label = copy_of(label).site;
  return window;
}

std::vector<int> share_bends(const Torus& torus, const CellGraph& graph, Bends& bends) {
  using End = std::tuple<Corner, int>;  // a junction on the torus, and which way an arc leaves it
  const auto ends_of = [&](const Arc& arc) {
    return std::pair<End, End>{{wrapped_corner(torus, graph.junctions[arc.from]), arc.direction_from},
                               {wrapped_corner(torus, graph.junctions[arc.to]), arc.direction_to}};
  };
  std::map<End, int> most;  // by the lesser end
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const auto [from, to] = ends_of(graph.arcs[k]);
    int& best = most.try_emplace(std::min(from, to), static_cast<int>(k)).first->second;
    if (bends[k].size() > bends[best].size()) best = static_cast<int>(k);
  }
  std::vector<int> shared(bends.size());
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const auto [from, to] = ends_of(graph.arcs[k]);
    shared[k] = most[std::min(from, to)];
  }
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const Arc &arc = graph.arcs[k], &other = graph.arcs[shared[k]];
    if (shared[k] == static_cast<int>(k)) continue;
    const bool back = ends_of(arc).first != ends_of(other).first;
    const Point way =
        position_of(graph.junctions[arc.from]) - position_of(graph.junctions[back ? other.to : other.from]);
    bends[k] = bends[shared[k]];
    if (back) std::reverse(bends[k].begin(), bends[k].end());
    for (Point& p : bends[k]) p += way;
  }
  return shared;
}

void fold(const Torus& torus, const CellGraph& graph, const Bends& bends, const std::vector<int>& shared, int own,
          int sites, Tessellation& t) {
  const Folding folding = fold_vertices(torus, graph, bends, shared);
  const Tessellation all = t;
  t.map.first = {0};
  t.map.ring.clear();
  t.zone.clear();
  t.half_side.clear();
  t.frame.clear();
  for (int cell = 0; cell < all.cells(); ++cell) {
    const bool keeps = cell < own || (cell >= sites && centre_in_window(torus, all.map, cell));
    if (!keeps) continue;
    for (int slot = all.map.first[cell]; slot < all.map.first[cell + 1]; ++slot) {
      t.map.ring.push_back(folding.vertex[all.map.ring[slot]]);
      t.map.shift.push_back(folding.shift[all.map.ring[slot]]);
    }
    t.map.first.push_back(static_cast<int>(t.map.ring.size()));
    t.zone.push_back(all.zone[cell]);
    t.half_side.push_back(all.half_side[cell]);
    t.frame.push_back(all.frame[cell]);
  }
}

}  // namespace tessera::mosaic

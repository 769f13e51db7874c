#include "tessera/pebbles/region_tree.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

namespace tessera::pebbles {
namespace {

struct Corner {
  int x, y;
};
using Hull = std::vector<Corner>;  // counter-clockwise

std::int64_t turn(Corner a, Corner b, Corner c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

// Andrew's monotone chain; the points are in the order of x, then y.
Hull hull_of(const std::vector<Corner>& points) {
  Hull hull;
  hull.reserve(points.size());
  const auto add = [&hull](Corner p, std::size_t least) {
    while (hull.size() >= least + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Corner p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t k = points.size() - 1; k-- > 0;) add(points[k], lower);
  hull.pop_back();
  return hull;
}

bool before(Corner a, Corner b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

double area_of(const Hull& hull) {
  std::int64_t twice = 0;
  for (std::size_t k = 1; k + 1 < hull.size(); ++k) twice += turn(hull[0], hull[k], hull[k + 1]);
  return static_cast<double>(twice) / 2;
}

Hull joined(const Hull& a, const Hull& b) {
  std::vector<Corner> points;
  points.reserve(a.size() + b.size());
  points.insert(points.end(), a.begin(), a.end());
  points.insert(points.end(), b.begin(), b.end());
  std::sort(points.begin(), points.end(), before);
  return hull_of(points);
}

// The corners of each label's pixels that may be corners of its hull: the ends of its rows.
std::vector<Hull> hulls_of(const cv::Mat1i& labels, int count) {
  struct Ends {
    int y = -1, least = 0, most = 0;
  };
  std::vector<std::vector<Corner>> points(count);
  std::vector<Ends> ends(count);
  const auto flush = [&](int b) {
    if (ends[b].y < 0) return;
    for (const int y : {ends[b].y, ends[b].y + 1}) {
      points[b].push_back({ends[b].least, y});
      points[b].push_back({ends[b].most, y});
    }
  };
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const int b = labels(y, x);
      if (ends[b].y != y) {
        flush(b);
        ends[b] = {y, x, x + 1};
      }
      ends[b].most = x + 1;
    }
  std::vector<Hull> hulls(count);
  for (int b = 0; b < count; ++b) {
    if (ends[b].y < 0) continue;
    flush(b);
    std::sort(points[b].begin(), points[b].end(), before);
    hulls[b] = hull_of(points[b]);
  }
  return hulls;
}

// Borders between regions, and the weakest of them.
class Borders {
 public:
  Borders(const Basins& basins, const cv::Mat1w& strength) : edges_of_(basins.count) {
    const cv::Mat1i& labels = basins.labels;
    const auto meet = [&](int y, int x, int yy, int xx) {
      const int a = labels(y, x), b = labels(yy, xx);
      if (a != b) add(a, b, std::max<int>(strength(y, x), strength(yy, xx)));
    };
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x) {
        if (x + 1 < labels.cols) meet(y, x, y, x + 1);
        if (y + 1 < labels.rows) meet(y, x, y + 1, x);
      }
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) offer(e);
  }

  struct Join {
    int a = -1, b = -1;
    double strength = 0;
  };
  // The two regions (slots) with the weakest border; a < 0: there are none.
  Join weakest() {
    while (!queue_.empty()) {
      const Offer best = queue_.top();
      queue_.pop();
      const Edge& edge = edges_[best.edge];
      if (edge.count != 0 && edge.count == best.count) return {edge.a, edge.b, best.mean};
    }
    return {};
  }
  // Joins slot b to slot a or a to b, whichever has less borders; returns the slot that is left.
  int join(int a, int b) {
    if (edges_of_[a].size() < edges_of_[b].size()) std::swap(a, b);
    remove(index_.at(key(a, b)));
    for (const int e : edges_of_[b]) {
      if (edges_[e].count == 0) continue;
      const int other = edges_[e].a == b ? edges_[e].b : edges_[e].a;
      index_.erase(key(b, other));
      const auto [at, is_new] = index_.try_emplace(key(a, other), e);
      if (is_new) {
        edges_[e].a = a;
        edges_[e].b = other;
        edges_of_[a].push_back(e);
      } else {
        edges_[at->second].sum += edges_[e].sum;
        edges_[at->second].count += edges_[e].count;
        edges_[e].count = 0;
        offer(at->second);
      }
    }
    edges_of_[b] = {};
    return a;
  }

 private:
  struct Edge {
    int a, b;
    std::int64_t sum = 0, count = 0;
  };
  struct Offer {
    double mean;
    std::int64_t count;
    int edge;
    bool operator<(const Offer& o) const { return mean != o.mean ? mean > o.mean : edge > o.edge; }
  };
  static std::uint64_t key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  }
  void add(int a, int b, int strength) {
    const auto [at, is_new] = index_.try_emplace(key(a, b), static_cast<int>(edges_.size()));
    if (is_new) {
      edges_of_[a].push_back(at->second);
      edges_of_[b].push_back(at->second);
      edges_.push_back({a, b});
    }
    edges_[at->second].sum += strength;
    ++edges_[at->second].count;
  }
  void remove(int edge) {
    index_.erase(key(edges_[edge].a, edges_[edge].b));
    edges_[edge].count = 0;
  }
  void offer(int e) {
    queue_.push({static_cast<double>(edges_[e].sum) / static_cast<double>(edges_[e].count), edges_[e].count, e});
  }

  std::vector<Edge> edges_;
  std::vector<std::vector<int>> edges_of_;
  std::unordered_map<std::uint64_t, int> index_;
  std::priority_queue<Offer> queue_;
};

}  // namespace

Moments& Moments::operator+=(const Moments& o) {
  count += o.count, x += o.x, y += o.y, xx += o.xx, xy += o.xy, yy += o.yy;
  return *this;
}

double Moments::ellipse_area() const {
  const double n = static_cast<double>(count), mx = static_cast<double>(x) / n, my = static_cast<double>(y) / n;
  // A pixel is a square, not a point: a twelfth.
  const double vx = static_cast<double>(xx) / n - mx * mx + 1.0 / 12,
               vy = static_cast<double>(yy) / n - my * my + 1.0 / 12, c = static_cast<double>(xy) / n - mx * my;
  return 4 * 3.14159265358979323846 * std::sqrt(std::max(0.0, vx * vy - c * c));
}

std::vector<double> hull_areas(const cv::Mat1i& labels, int count) {
  std::vector<double> areas;
  for (const Hull& hull : hulls_of(labels, count)) areas.push_back(area_of(hull));
  return areas;
}

std::vector<Region> region_tree(const Basins& basins, const cv::Mat1w& strength) {
  std::vector<Region> regions(basins.count);
  regions.reserve(2 * static_cast<std::size_t>(basins.count));
  for (int y = 0; y < basins.labels.rows; ++y)
    for (int x = 0; x < basins.labels.cols; ++x) {
      Region& r = regions[basins.labels(y, x)];
      const std::int64_t i = x, j = y;
      r.moments += {1, i, j, i * i, i * j, j * j};
      r.border += (x == 0) + (y == 0) + (x + 1 == basins.labels.cols) + (y + 1 == basins.labels.rows);
    }
  std::vector<Hull> hulls = hulls_of(basins.labels, basins.count);
  for (int b = 0; b < basins.count; ++b) regions[b].hull_area = area_of(hulls[b]);
  std::vector<int> region_in(basins.count);  // of a slot of `borders`
  for (int b = 0; b < basins.count; ++b) region_in[b] = b;
  Borders borders(basins, strength);
  for (auto next = borders.weakest(); next.a >= 0; next = borders.weakest()) {
    const int left = region_in[next.a], right = region_in[next.b], own = static_cast<int>(regions.size());
    const int slot = borders.join(next.a, next.b), gone = slot == next.a ? next.b : next.a;
    hulls[slot] = joined(hulls[next.a], hulls[next.b]);
    hulls[gone] = {};
    Region region{regions[left].moments, left, right, -1, next.strength, area_of(hulls[slot])};
    region.moments += regions[right].moments;
    region.border = regions[left].border + regions[right].border;
    regions[left].parent = regions[right].parent = own;
    regions.push_back(region);
    region_in[slot] = own;
  }
  return regions;
}

}  // namespace tessera::pebbles

#include "tessera/voronoi/trace.h"

#include <algorithm>
#include <numeric>

#include "tessera/voronoi/cells.h"
#include "tessera/voronoi/lloyd.h"

namespace tessera {
namespace {

constexpr int kStepX[] = {1, 0, -1, 0}, kStepY[] = {0, 1, 0, -1};

int label_at(const LabelMap& labels, int x, int y) {
  return x < 0 || y < 0 || x >= labels.cols || y >= labels.rows ? kOutside : labels(y, x);
}

// Labels of the pixels NW, NE, SE, SW of a corner.
std::array<int, 4> around(const LabelMap& labels, int x, int y) {
  if (x > 0 && y > 0 && x < labels.cols && y < labels.rows) {
    const int *upper = labels[y - 1] + x, *lower = labels[y] + x;
    return {upper[-1], upper[0], lower[0], lower[-1]};
  }
  return {label_at(labels, x - 1, y - 1), label_at(labels, x, y - 1), label_at(labels, x, y), label_at(labels, x - 1, y)};
}

// The pair of labels (left, right) beside the pixel side that leaves a corner in a direction.
std::pair<int, int> beside(const std::array<int, 4>& a, int direction) {
  return {a[(direction + 1) & 3], a[(direction + 2) & 3]};
}

bool is_junction(const std::array<int, 4>& a) {
  const int different = (a[0] != a[1]) + (a[1] != a[2]) + (a[2] != a[3]) + (a[3] != a[0]);
  if (different >= 3) return true;
  // The picture's four corners are vertices although only one cell is there.
  return std::count(a.begin(), a.end(), kOutside) == 3;
}

// Junctions in reading order, and for each corner of the grid its junction or -1.
void find_junctions(const LabelMap& labels, std::vector<Junction>& junctions, cv::Mat1i& index) {
  index.create(labels.rows + 1, labels.cols + 1);
  index.setTo(-1);
  const auto visit = [&](int x, int y) {
    const auto a = around(labels, x, y);
    if (!is_junction(a)) return;
    index(y, x) = static_cast<int>(junctions.size());
    junctions.push_back({x, y, a, {-1, -1, -1, -1}});
  };
  for (int y = 0; y <= labels.rows; ++y) {
    if (y == 0 || y == labels.rows) {
      for (int x = 0; x <= labels.cols; ++x) visit(x, y);
      continue;
    }
    visit(0, y);
    const int *upper = labels[y - 1], *lower = labels[y];
    for (int x = 1; x < labels.cols; ++x) {
      // Two labels at most along both diagonals' rows: nothing to see here, most of the time.
      if (upper[x] == upper[x - 1] && lower[x] == lower[x - 1]) continue;
      if (upper[x] == lower[x] && upper[x - 1] == lower[x - 1]) continue;
      visit(x, y);
    }
    visit(labels.cols, y);
  }
}

// The way on from a plain corner reached in `heading`: of the three others the one where labels differ, right first.
int turn(const std::array<int, 4>& a, int heading) {
  for (const int direction : {(heading + 1) & 3, heading, (heading + 3) & 3}) {
    const auto [left, right] = beside(a, direction);
    if (left != right) return direction;
  }
  return (heading + 2) & 3;
}

}  // namespace

int CellGraph::next(int half_edge) const {
  const Arc& arc = arcs[half_edge >> 1];
  const int back = half_edge & 1 ? arc.direction_from : arc.direction_to;
  const Junction& junction = junctions[head(half_edge)];
  // Right first: a cell's pixels that only touch at this corner are not joined here.
  for (const int turn : {3, 2, 1, 0}) {
    const int out = junction.half_edges[(back + turn) & 3];
    if (out >= 0) return out;
  }
  return half_edge ^ 1;
}

CellGraph trace_cells(const LabelMap& labels) {
  CellGraph graph;
  cv::Mat1i index;
  find_junctions(labels, graph.junctions, index);
  graph.arcs.reserve(graph.junctions.size() * 3 / 2 + 8);
  for (std::size_t j = 0; j < graph.junctions.size(); ++j) {
    for (int direction = 0; direction < 4; ++direction) {
      const auto [left, right] = beside(graph.junctions[j].labels, direction);
      if (left == right || graph.junctions[j].half_edges[direction] >= 0) continue;
      Arc arc{static_cast<int>(j), 0, direction, 0, left, right, 0};
      int x = graph.junctions[j].x, y = graph.junctions[j].y, heading = direction;
      for (;;) {
        x += kStepX[heading];
        y += kStepY[heading];
        ++arc.length;
        if (index(y, x) >= 0) break;
        heading = turn(around(labels, x, y), heading);
      }
      arc.to = index(y, x);
      arc.direction_to = (heading + 2) & 3;
      const int k = static_cast<int>(graph.arcs.size());
      graph.junctions[j].half_edges[direction] = 2 * k;
      graph.junctions[arc.to].half_edges[arc.direction_to] = 2 * k + 1;
      graph.arcs.push_back(arc);
    }
  }
  return graph;
}

std::vector<cv::Point> walk_arc(const CellGraph& graph, const LabelMap& labels, int k) {
  const Arc& arc = graph.arcs[k];
  const Junction& from = graph.junctions[arc.from];
  std::vector<cv::Point> corners{{from.x, from.y}};
  int x = from.x, y = from.y, heading = arc.direction_from;
  for (int i = 0; i < arc.length; ++i) {
    x += kStepX[heading];
    y += kStepY[heading];
    corners.push_back({x, y});
    if (i + 1 < arc.length) heading = turn(around(labels, x, y), heading);
  }
  return corners;
}

std::vector<std::vector<int>> cell_rings(const CellGraph& graph, int cells, std::vector<int>& enclosing) {
  std::vector<std::vector<int>> rings(cells);
  std::vector<bool> seen(2 * graph.arcs.size(), false);
  for (int start = 0; start < static_cast<int>(seen.size()); ++start) {
    const int label = graph.label_right(start);
    if (seen[start] || label < 0) continue;
    std::vector<int> ring;
    for (int h = start; !seen[h]; h = graph.next(h)) {
      seen[h] = true;
      ring.push_back(h);
    }
    if (!rings[label].empty()) enclosing.push_back(label);
    if (ring.size() > rings[label].size()) rings[label] = std::move(ring);
  }
  return rings;
}

namespace {

// A cell that encloses another, and a point within the enclosed one.
struct Enclosure {
  int cell;
  double x, y;
};

// The junctions of a ring that is not its cell's outer one lie around what it encloses.
std::vector<Enclosure> find_enclosures(const LabelMap& labels, int cells) {
  const CellGraph graph = trace_cells(labels);
  std::vector<int> enclosing;
  const auto rings = cell_rings(graph, cells, enclosing);
  std::vector<Enclosure> found;
  std::sort(enclosing.begin(), enclosing.end());
  enclosing.erase(std::unique(enclosing.begin(), enclosing.end()), enclosing.end());
  if (!enclosing.empty()) {
    std::vector<bool> outer(2 * graph.arcs.size(), false);
    for (const int cell : enclosing)
      for (const int h : rings[cell]) outer[h] = true;
    for (int h = 0; h < static_cast<int>(outer.size()); ++h) {
      const int label = graph.label_right(h);
      if (outer[h] || !std::binary_search(enclosing.begin(), enclosing.end(), label)) continue;
      const Junction& junction = graph.junctions[graph.tail(h)];
      found.push_back({label, static_cast<double>(junction.x), static_cast<double>(junction.y)});
    }
  }
  // A cell that touches itself at a corner has what lies between enclosed, too.
  for (const Junction& junction : graph.junctions) {
    const auto& a = junction.labels;
    for (int d = 0; d < 2; ++d)
      if (a[d] >= 0 && a[d] == a[d + 2] && a[d] != a[1 - d] && a[d] != a[3 - d])
        found.push_back({a[d], static_cast<double>(junction.x), static_cast<double>(junction.y)});
  }
  // Cells without a junction: all around them is one other cell.
  std::vector<bool> alone(cells, false);
  bool any = false;
  for (int cell = 0; cell < cells; ++cell) any |= alone[cell] = rings[cell].empty();
  if (!any) return found;
  const auto moments = cell_moments(labels, cells);
  std::vector<bool> done(cells, false);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 1; x < labels.cols; ++x) {
      const int cell = labels(y, x);
      if (!alone[cell] || done[cell] || labels(y, x - 1) == cell) continue;
      done[cell] = true;
      found.push_back({labels(y, x - 1), moments[cell].centroid_x(), moments[cell].centroid_y()});
    }
  }
  return found;
}

}  // namespace

namespace {

// For each cell the enclosed point to cut through, as an index or -1: the median along the cut's axis, so that the number
// of enclosed cells halves with each round.
std::vector<int> choose_cuts(const std::vector<Enclosure>& enclosures, int cells, bool along_x) {
  std::vector<int> order(enclosures.size()), cut(cells, -1);
  std::iota(order.begin(), order.end(), 0);
  const auto where = [&](int i) { return along_x ? enclosures[i].x : enclosures[i].y; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return enclosures[a].cell != enclosures[b].cell ? enclosures[a].cell < enclosures[b].cell : where(a) < where(b);
  });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const int cell = enclosures[order[begin]].cell;
    while (end < order.size() && enclosures[order[end]].cell == cell) ++end;
    cut[cell] = order[(begin + end) / 2];
  }
  return cut;
}

}  // namespace

int open_enclosures(LabelMap& labels, const cv::Mat1b& zones, int cells) {
  // Cuts halve what is enclosed, so this many rounds do for any picture.
  constexpr int kRounds = 64;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Enclosure> enclosures = find_enclosures(labels, cells);
    if (enclosures.empty()) return cells;
    const bool along_x = round % 2 == 0;
    const std::vector<int> cut = choose_cuts(enclosures, cells, along_x);
    // The part on the far side of a line through the enclosed point becomes a new cell.
    std::vector<int> new_label(cells, -1);
    int next = cells;
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) {
        const int cell = labels(y, x);
        if (cell >= cells || cut[cell] < 0) continue;
        const Enclosure& e = enclosures[cut[cell]];
        if (along_x ? x + 0.5 <= e.x : y + 0.5 <= e.y) continue;
        if (new_label[cell] < 0) new_label[cell] = next++;
        labels(y, x) = new_label[cell];
      }
    }
    cells = connect_cells(labels, zones, next);
  }
  return cells;
}

}  // namespace tessera

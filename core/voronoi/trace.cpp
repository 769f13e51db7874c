#include "tessera/voronoi/trace.h"

#include <algorithm>
#include <numeric>
#include <opencv2/core/utility.hpp>

#include "tessera/voronoi/cells.h"
#include "tessera/voronoi/lloyd.h"

namespace tessera {
namespace {

constexpr int kStepX[] = {1, 0, -1, 0}, kStepY[] = {0, 1, 0, -1};

int label_at(const LabelMap& labels, int x, int y) {
  return x < 0 || y < 0 || x >= labels.cols || y >= labels.rows ? kOutside : labels(y, x);
}

// Labels of the pixels NW, NE, SE, SW of a corner.
inline std::array<int, 4> around(const LabelMap& labels, int x, int y) {
  if (x > 0 && y > 0 && x < labels.cols && y < labels.rows) {
    const int *upper = labels[y - 1] + x, *lower = labels[y] + x;
    return {upper[-1], upper[0], lower[0], lower[-1]};
  }
  return {label_at(labels, x - 1, y - 1), label_at(labels, x, y - 1), label_at(labels, x, y),
          label_at(labels, x - 1, y)};
}

// The pair of labels (left, right) beside the pixel side that leaves a corner in a direction.
std::pair<int, int> beside(const std::array<int, 4>& a, int direction) {
  return {a[(direction + 1) & 3], a[(direction + 2) & 3]};
}

bool is_junction(const std::array<int, 4>& a) {
  const int different = (a[0] != a[1]) + (a[1] != a[2]) + (a[2] != a[3]) + (a[3] != a[0]);
  // The picture's four corners are vertices although only one cell is there.
  return different >= 3 || std::count(a.begin(), a.end(), kOutside) == 3;
}

void find_in_row(const LabelMap& labels, int y, std::vector<Junction>& junctions) {
  const auto visit = [&](int x) {
    const auto a = around(labels, x, y);
    if (is_junction(a)) junctions.push_back({x, y, a, {-1, -1, -1, -1}});
  };
  if (y == 0 || y == labels.rows) {
    for (int x = 0; x <= labels.cols; ++x) visit(x);
    return;
  }
  visit(0);
  const int *upper = labels[y - 1], *lower = labels[y];
  for (int x = 1; x < labels.cols; ++x) {
    // Two labels at most along both diagonals' rows: nothing to see here, most of the time.
    if ((upper[x] == upper[x - 1]) & (lower[x] == lower[x - 1])) continue;
    if ((upper[x] == lower[x]) & (upper[x - 1] == lower[x - 1])) continue;
    visit(x);
  }
  visit(labels.cols);
}

// In reading order, and where each row of them begins.
struct Junctions {
  std::vector<Junction> all;
  std::vector<int> row_first;

  int at(int x, int y) const {
    const auto begin = all.begin() + row_first[y], end = all.begin() + row_first[y + 1];
    return static_cast<int>(
        std::lower_bound(begin, end, x, [](const Junction& j, int column) { return j.x < column; }) - all.begin());
  }
};

Junctions find_junctions(const LabelMap& labels) {
  constexpr int kStripe = 32;  // rows
  const int rows = labels.rows + 1, stripes = (rows + kStripe - 1) / kStripe;
  Junctions junctions;
  junctions.row_first.assign(rows + 1, 0);
  std::vector<std::vector<Junction>> found(stripes);
  cv::parallel_for_({0, stripes}, [&](const cv::Range& range) {
    for (int y = range.start * kStripe; y < std::min(rows, range.end * kStripe); ++y) {
      std::vector<Junction>& stripe = found[y / kStripe];
      const std::size_t before = stripe.size();
      find_in_row(labels, y, stripe);
      junctions.row_first[y + 1] = static_cast<int>(stripe.size() - before);
    }
  });
  std::partial_sum(junctions.row_first.begin(), junctions.row_first.end(), junctions.row_first.begin());
  junctions.all.reserve(junctions.row_first.back());
  for (const auto& stripe : found) junctions.all.insert(junctions.all.end(), stripe.begin(), stripe.end());
  return junctions;
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
  Junctions junctions = find_junctions(labels);
  CellGraph graph;
  graph.arcs.reserve(junctions.all.size() * 3 / 2 + 8);
  for (std::size_t j = 0; j < junctions.all.size(); ++j) {
    for (int direction = 0; direction < 4; ++direction) {
      const auto [left, right] = beside(junctions.all[j].labels, direction);
      if (left == right || junctions.all[j].half_edges[direction] >= 0) continue;
      Arc arc{static_cast<int>(j), 0, direction, 0, left, right, 0};
      int x = junctions.all[j].x, y = junctions.all[j].y, heading = direction;
      for (;;) {
        x += kStepX[heading];
        y += kStepY[heading];
        ++arc.length;
        const auto a = around(labels, x, y);
        if (is_junction(a)) break;
        heading = turn(a, heading);
      }
      arc.to = junctions.at(x, y);
      arc.direction_to = (heading + 2) & 3;
      const int k = static_cast<int>(graph.arcs.size());
      junctions.all[j].half_edges[direction] = 2 * k;
      junctions.all[arc.to].half_edges[arc.direction_to] = 2 * k + 1;
      graph.arcs.push_back(arc);
    }
  }
  graph.junctions = std::move(junctions.all);
  return graph;
}

CellGraph trace_cells_and_islands(const LabelMap& labels, int cells) {
  CellGraph graph = trace_cells(labels);
  cv::Mat1b met(labels.rows + 1, labels.cols + 1, static_cast<std::uint8_t>(0));  // corners on arcs
  for (int k = 0; k < static_cast<int>(graph.arcs.size()); ++k)
    for (const cv::Point corner : walk_arc(graph, labels, k)) met(corner) = 1;
  std::vector<bool> seen(cells, false);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int cell = labels(y, x);
      if (seen[cell]) continue;
      seen[cell] = true;
      if (met(y, x) != 0) continue;
      // Around the corner: the other cell, and in the south east this one. Clockwise from there and back.
      constexpr int kEast = 0, kSouth = 1;
      const int junction = static_cast<int>(graph.junctions.size()), k = static_cast<int>(graph.arcs.size());
      graph.junctions.push_back({x, y, around(labels, x, y), {2 * k, 2 * k + 1, -1, -1}});
      Arc arc{junction, junction, kEast, kSouth, labels(y - 1, x), cell, 0};
      int heading = kEast;
      cv::Point at(x, y);
      do {
        at += cv::Point(kStepX[heading], kStepY[heading]);
        ++arc.length;
        heading = turn(around(labels, at.x, at.y), heading);
      } while (at.x != x || at.y != y);
      graph.arcs.push_back(arc);
    }
  }
  return graph;
}

std::vector<std::vector<std::vector<int>>> cell_walks(const CellGraph& graph, int cells) {
  std::vector<std::vector<std::vector<int>>> walks(cells);
  std::vector<char> seen(2 * graph.arcs.size(), 0);
  for (int start = 0; start < static_cast<int>(seen.size()); ++start) {
    const int label = graph.label_right(start);
    if (seen[start] || label < 0) continue;
    std::vector<int>& walk = walks[label].emplace_back();
    for (int h = start; !seen[h]; h = graph.next(h)) {
      seen[h] = 1;
      walk.push_back(h);
    }
  }
  return walks;
}

std::vector<cv::Point> walk_arc(const CellGraph& graph, const LabelMap& labels, int arc) {
  const Arc& way = graph.arcs[arc];
  const Junction& from = graph.junctions[way.from];
  std::vector<cv::Point> corners{{from.x, from.y}};
  int x = from.x, y = from.y, heading = way.direction_from;
  for (int i = 0; i < way.length; ++i) {
    x += kStepX[heading];
    y += kStepY[heading];
    corners.push_back({x, y});
    if (i + 1 < way.length) heading = turn(around(labels, x, y), heading);
  }
  return corners;
}

CellRings cell_rings(const CellGraph& graph, int cells, std::vector<int>& enclosing) {
  struct Walk {
    int begin = 0, end = 0;  // in `walked`
  };
  std::vector<Walk> longest(cells);
  std::vector<int> walked;
  walked.reserve(2 * graph.arcs.size());
  std::vector<char> seen(2 * graph.arcs.size(), 0);
  for (int start = 0; start < static_cast<int>(seen.size()); ++start) {
    const int label = graph.label_right(start);
    if (seen[start] || label < 0) continue;
    Walk walk{static_cast<int>(walked.size()), 0};
    for (int h = start; !seen[h]; h = graph.next(h)) {
      seen[h] = 1;
      walked.push_back(h);
    }
    walk.end = static_cast<int>(walked.size());
    Walk& best = longest[label];
    if (best.end > best.begin) enclosing.push_back(label);
    if (walk.end - walk.begin > best.end - best.begin) best = walk;
  }
  CellRings rings;
  rings.half_edges.reserve(walked.size());
  for (const Walk& walk : longest) {
    rings.half_edges.insert(rings.half_edges.end(), walked.begin() + walk.begin, walked.begin() + walk.end);
    rings.first.push_back(static_cast<int>(rings.half_edges.size()));
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
std::vector<Enclosure> find_enclosures(const CellGraph& graph, const LabelMap& labels, int cells) {
  std::vector<int> enclosing;
  const CellRings rings = cell_rings(graph, cells, enclosing);
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

// For each cell the enclosed point to cut through, as an index or -1: the median along the cut's axis, so that the
// number of enclosed cells halves with each round.
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

CellGraph open_enclosures(LabelMap& labels, const cv::Mat1b& zones, int& cells) {
  // Cuts halve what is enclosed, so this many rounds do for any picture.
  constexpr int kRounds = 64;
  CellGraph graph = trace_cells(labels);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Enclosure> enclosures = find_enclosures(graph, labels, cells);
    if (enclosures.empty()) break;
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
    graph = trace_cells(labels);
  }
  return graph;
}

}  // namespace tessera

#include "tessera/voronoi/smooth_outlines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/voronoi/trace.h"

namespace tessera {
namespace {

using Line = std::vector<Point>;

double distance_to_side(Point p, Point a, Point b) {
  const Point way = b - a;
  const double squared = dot(way, way);
  const double along = squared > 0 ? std::clamp(dot(p - a, way) / squared, 0.0, 1.0) : 0;
  return length(p - (a + along * way));
}

// Marks what has to stay between two points of the line that do.
void mark_corners(const Line& line, std::size_t first, std::size_t last, double tolerance, std::vector<bool>& stays) {
  std::vector<std::pair<std::size_t, std::size_t>> parts{{first, last}};
  while (!parts.empty()) {
    const auto [begin, end] = parts.back();
    parts.pop_back();
    double farthest = tolerance;
    std::size_t at = begin;
    for (std::size_t i = begin + 1; i < end; ++i)
      if (const double d = distance_to_side(line[i], line[begin], line[end]); d > farthest) farthest = d, at = i;
    if (at == begin) continue;
    stays[at] = true;
    parts.emplace_back(begin, at);
    parts.emplace_back(at, end);
  }
}

// A loop has its last point where its first is, and is halved at the point farthest from there.
Line simplified(const Line& line, double tolerance) {
  std::vector<bool> stays(line.size(), false);
  stays.front() = stays.back() = true;
  std::size_t half = line.size() - 1;
  if (line.front() == line.back()) {
    half = static_cast<std::size_t>(
        std::max_element(line.begin(), line.end(),
                         [&](Point a, Point b) { return length(a - line[0]) < length(b - line[0]); }) -
        line.begin());
    stays[half] = true;
    mark_corners(line, half, line.size() - 1, tolerance, stays);
  }
  mark_corners(line, 0, half, tolerance, stays);
  Line kept;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (stays[i]) kept.push_back(line[i]);
  return kept;
}

// What comes in the place of a corner: itself where it is sharp, else two points on its sides, so that no more than
// `most` is cut off.
void append_cut(Point before, Point corner, Point after, double most, Line& to) {
  constexpr double kSharpCosine = 0.5;  // turns of 60 degrees and more are meant
  const Point in = corner - before, out = after - corner;
  const double a = length(in), b = length(out);
  const double cosine = dot(in, out) / (a * b);
  if (!(cosine > kSharpCosine)) {
    to.push_back(corner);
    return;
  }
  const double half_sine = std::sqrt(std::max(0.0, (1 - cosine) / 2));  // of half the turn
  const double along = half_sine > 0 ? most / half_sine : a;
  to.push_back(corner - std::min(0.25, along / a) * in);
  to.push_back(corner + std::min(0.25, along / b) * out);
}

Line with_blunt_corners_cut(const Line& line, bool is_island, double most) {
  if (line.size() < 3) return line;
  const std::size_t last = line.size() - 1;
  Line cut;
  if (!is_island) cut.push_back(line.front());
  for (std::size_t i = is_island ? 0 : 1; i < last; ++i)
    append_cut(i > 0 ? line[i - 1] : line[last - 1], line[i], line[i + 1], most, cut);
  cut.push_back(is_island ? cut.front() : line.back());
  return cut;
}

Line line_of(const CellGraph& graph, const LabelMap& labels, int arc) {
  Line line;
  for (const cv::Point corner : walk_arc(graph, labels, arc))
    line.push_back({static_cast<double>(corner.x), static_cast<double>(corner.y)});
  return line;
}

// Through the middles of the pixels' sides, which are nearer to a slope that they stand for than their ends, and the
// corners between straight runs that are no stairs. An island's has its first point again at its end.
Line course_of(const Line& corners, bool is_island) {
  constexpr std::size_t kStraight = 4;  // sides
  const std::size_t sides = corners.size() - 1;
  const auto turns_before = [&](std::size_t i) {  // at corners[i]
    const Point in = i > 0 ? corners[i] - corners[i - 1] : corners[sides] - corners[sides - 1];
    return !(in == corners[i + 1] - corners[i]);
  };
  const auto goes_on = [&](std::size_t i) {  // for so many sides from corners[i]
    std::size_t run = 1;
    while (run < kStraight && i + run < sides && !turns_before(i + run)) ++run;
    return run;
  };
  const auto came = [&](std::size_t i) {  // the same, to there
    std::size_t run = 1;
    while (run < kStraight && i > run && !turns_before(i - run)) ++run;
    return run;
  };
  Line course;
  for (std::size_t i = 0; i < sides; ++i) {
    const bool is_end = i == 0 && !is_island;
    const bool is_corner = turns_before(i) && goes_on(i) == kStraight && came(i > 0 ? i : sides) == kStraight;
    if (is_end || is_corner) course.push_back(corners[i]);
    course.push_back(0.5 * (corners[i] + corners[i + 1]));
  }
  course.push_back(is_island ? course.front() : corners.back());
  return course;
}

Line smoothed(const CellGraph& graph, int arc, Line line, double tolerance) {
  constexpr int kRounds = 2;
  const Junction& junction = graph.junctions[graph.arcs[arc].from];
  const bool is_island = std::count(junction.half_edges.begin(), junction.half_edges.end(), -1) == 2 &&
                         graph.arcs[arc].from == graph.arcs[arc].to;
  line = simplified(course_of(line, is_island), tolerance);
  for (int round = 0; round < kRounds; ++round) line = with_blunt_corners_cut(line, is_island, tolerance);
  return line;
}

// The line's corners between pixels only.
Line straightened(const Line& line) { return simplified(line, 1e-9); }

Ring ring_of(const std::vector<int>& walk, const std::vector<Line>& lines) {
  Ring ring;
  for (const int h : walk) {
    const Line& line = lines[h >> 1];
    if (h & 1)
      ring.insert(ring.end(), line.rbegin(), line.rend() - 1);
    else
      ring.insert(ring.end(), line.begin(), line.end() - 1);
  }
  return ring;
}

struct Side {
  Point a, b;
  int ring;
  std::size_t index, count;  // of the ring's sides
  double low() const { return std::min(a.x, b.x); }
  double high() const { return std::max(a.x, b.x); }
};

bool are_neighbours(const Side& s, const Side& t) {
  return s.ring == t.ring && ((s.index + 1) % s.count == t.index || (t.index + 1) % t.count == s.index);
}

// Neighbours may share their common vertex only.
bool meet(const Side& s, const Side& t) {
  if (std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) || std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y))
    return false;
  const auto turn = [](Point p, Point q, Point r) { return cross(q - p, r - p); };
  if (are_neighbours(s, t)) {
    const bool follows = (s.index + 1) % s.count == t.index;
    const Side &first = follows ? s : t, &second = follows ? t : s;
    return turn(first.a, first.b, second.b) == 0 && dot(first.b - first.a, second.b - second.a) < 0;
  }
  return turn(s.a, s.b, t.a) * turn(s.a, s.b, t.b) <= 0 && turn(t.a, t.b, s.a) * turn(t.a, t.b, s.b) <= 0;
}

bool is_good(const Polygon& cell) {
  if (cell.outer.size() < 3) return false;
  std::vector<Side> sides;
  int number = 0;
  const auto append = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      sides.push_back({ring[i], ring[i + 1 < ring.size() ? i + 1 : 0], number, i, ring.size()});
    ++number;
  };
  append(cell.outer);
  for (const Ring& hole : cell.holes) append(hole);
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) { return s.low() < t.low(); });
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t k = i + 1; k < sides.size() && sides[k].low() <= sides[i].high(); ++k)
      if (meet(sides[i], sides[k])) return false;
  return true;
}

// The ring that is clockwise on the screen is the outer one.
Polygon outline_of(const std::vector<std::vector<int>>& walks, const std::vector<Line>& lines) {
  Polygon cell;
  for (const std::vector<int>& walk : walks) {
    Ring ring = ring_of(walk, lines);
    if (signed_area(ring) > 0 && cell.outer.empty())
      cell.outer = std::move(ring);
    else
      cell.holes.push_back(std::move(ring));
  }
  return cell;
}

}  // namespace

std::vector<Polygon> smooth_outlines(const LabelMap& labels, int cells, double tolerance) {
  const CellGraph graph = trace_cells_and_islands(labels, cells);
  const auto walks = cell_walks(graph, cells);
  const int arcs = static_cast<int>(graph.arcs.size());
  std::vector<Line> lines(arcs);
  cv::parallel_for_({0, arcs}, [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) lines[k] = smoothed(graph, k, line_of(graph, labels, k), tolerance);
  });
  std::vector<Polygon> outlines(cells);
  std::vector<bool> smooth(arcs, true);
  std::vector<int> to_do(cells);
  for (int cell = 0; cell < cells; ++cell) to_do[cell] = cell;
  // Cells whose boundary crosses itself get it back, and their neighbours are looked at again.
  while (!to_do.empty()) {
    std::vector<char> good(to_do.size());
    cv::parallel_for_({0, static_cast<int>(to_do.size())}, [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i) {
        outlines[to_do[i]] = outline_of(walks[to_do[i]], lines);
        good[i] = is_good(outlines[to_do[i]]);
      }
    });
    std::vector<int> again;
    for (std::size_t i = 0; i < to_do.size(); ++i) {
      if (good[i]) continue;
      for (const auto& walk : walks[to_do[i]])
        for (const int h : walk) {
          if (!smooth[h >> 1]) continue;
          smooth[h >> 1] = false;
          lines[h >> 1] = straightened(line_of(graph, labels, h >> 1));
          for (const int cell : {graph.label_left(h), graph.label_right(h)})
            if (cell >= 0) again.push_back(cell);
        }
    }
    std::sort(again.begin(), again.end());
    again.erase(std::unique(again.begin(), again.end()), again.end());
    to_do = std::move(again);
  }
  return outlines;
}

void part_corners(LabelMap& labels) {
  constexpr int kRounds = 8;
  bool found = true;
  for (int round = 0; found && round < kRounds; ++round) {
    found = false;
    for (int y = 0; y + 1 < labels.rows; ++y)
      for (int x = 0; x + 1 < labels.cols; ++x) {
        int &a = labels(y, x), &b = labels(y, x + 1), &c = labels(y + 1, x), &d = labels(y + 1, x + 1);
        if (a == d && a != b && a != c) {
          found = true;
          b = a;
        } else if (b == c && b != a && b != d) {
          found = true;
          a = b;
        }
      }
  }
}

}  // namespace tessera

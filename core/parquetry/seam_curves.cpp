#include "tessera/parquetry/seam_curves.h"

#include <algorithm>
#include <cmath>

namespace tessera::parquetry {
namespace {

constexpr double kFlatness = 0.1;    // of the error, what is left to the lines that curves are drawn with
constexpr int kSmoothings = 24;      // passes of a kernel of 1 2 1
constexpr double kCorridor = 0.49;   // px; so far a cut can be moved, and no pixel's middle changes sides
constexpr double kLeastSide = 0.25;  // px; nearer to a crossing no point of a cut is kept

// A seam as a function: where it is across its line, at any place along it.
class Line {
 public:
  explicit Line(const Seam& seam) : places_(seam.begin(), seam.end()) {
    std::vector<double> next = places_;
    for (int pass = 0; pass < kSmoothings; ++pass) {
      for (std::size_t k = 1; k + 1 < places_.size(); ++k)
        next[k] = std::clamp(0.25 * (places_[k - 1] + 2 * places_[k] + places_[k + 1]), seam[k] - kCorridor,
                             seam[k] + kCorridor);
      places_.swap(next);
    }
  }

  int length() const { return static_cast<int>(places_.size()); }
  double sample(int k) const { return places_[k]; }  // at k + 0.5

  double at(double along) const {
    const double place = std::clamp(along - 0.5, 0.0, length() - 1.0);
    const int k = std::min(static_cast<int>(place), std::max(0, length() - 2));
    return k + 1 < length() ? places_[k] + (place - k) * (places_[k + 1] - places_[k]) : places_[k];
  }
  double slope(double along) const {
    return (at(std::min(along + 1, 1.0 * length())) - at(std::max(along - 1, 0.0))) /
           (std::min(along + 1, 1.0 * length()) - std::max(along - 1, 0.0));
  }

 private:
  std::vector<double> places_;
};

// Both change by a pixel a pixel at most, so that y - row(column(y)) never falls: it is 0 where they cross.
Point crossing(const Line& column, const Line& row) {
  double low = 0, high = column.length();
  for (int step = 0; step < 60; ++step) {
    const double y = 0.5 * (low + high);
    (y < row.at(column.at(y)) ? low : high) = y;
  }
  const double x = column.at(0.5 * (low + high));
  return {x, row.at(x)};
}

// Points as a column seam sees them: place across, place along.
Point turned(Point p) { return {p.y, p.x}; }

class Edges {
 public:
  Edges(double error, Joints joints) : error_(error), joints_(joints) {}

  // A piece of `line` between two points of it.
  SeamEdge between(const Line& line, Point from, Point to, bool down) const {
    SeamEdge edge;
    edge.cut.push_back(from);
    for (int k = std::max(0, static_cast<int>(from.y)); k < line.length() && k + 0.5 < to.y - kLeastSide; ++k)
      if (k + 0.5 > from.y + kLeastSide) edge.cut.push_back({line.sample(k), k + 0.5});
    edge.cut.push_back(to);
    Point start = direction(line, from.y), end = direction(line, to.y);
    if (!down) {
      for (Point& p : edge.cut) p = turned(p);
      start = turned(start), end = turned(end);
    }
    const bool is_straight = std::all_of(edge.cut.begin(), edge.cut.end(), [&](Point p) {
      return cross(edge.cut.back() - edge.cut.front(), p - edge.cut.front()) == 0;
    });
    if (is_straight)
      edge.curves = {straight(edge.cut.front(), edge.cut.back())};
    else
      edge.curves = fit_beziers(edge.cut, (1 - kFlatness) * error_, joints_, start, end);
    edge.flat = {edge.cut.front()};
    for (const Bezier& curve : edge.curves) flatten(curve, kFlatness * error_, edge.flat);
    return edge;
  }

 private:
  static Point direction(const Line& line, double along) {
    const double slope = line.slope(along), size = std::sqrt(1 + slope * slope);
    return {slope / size, 1 / size};
  }

  double error_;
  Joints joints_;
};

}  // namespace

void append(const Ring& edge, bool backwards, Ring& ring) {
  if (backwards)
    ring.insert(ring.end(), edge.rbegin(), edge.rend() - 1);
  else
    ring.insert(ring.end(), edge.begin(), edge.end() - 1);
}

Ring SeamNetwork::outline(int column, int row) const {
  Ring ring;
  append(this->row(row, column).flat, false, ring);
  append(this->column(column + 1, row).flat, false, ring);
  append(this->row(row + 1, column).flat, true, ring);
  append(this->column(column, row).flat, true, ring);
  return ring;
}

SeamNetwork network_of(const Grid& grid, const Seams& seams, double error, Joints joints) {
  const std::vector<Line> columns(seams.columns.begin(), seams.columns.end()),
      rows(seams.rows.begin(), seams.rows.end());
  const int across = grid.across(), down = grid.down();
  std::vector<Point> nodes;  // row by row
  for (int row = 0; row <= down; ++row)
    for (int column = 0; column <= across; ++column) nodes.push_back(crossing(columns[column], rows[row]));
  const auto node = [&](int column, int row) { return nodes[row * (across + 1) + column]; };

  const Edges edges(error, joints);
  SeamNetwork network{across, down, std::vector<SeamEdge>(static_cast<std::size_t>(across + 1) * down),
                      std::vector<SeamEdge>(static_cast<std::size_t>(down + 1) * across)};
  cv::parallel_for_({0, across + 1}, [&](const cv::Range& range) {
    for (int line = range.start; line < range.end; ++line)
      for (int row = 0; row < down; ++row)
        network.columns[line * down + row] = edges.between(columns[line], node(line, row), node(line, row + 1), true);
  });
  cv::parallel_for_({0, down + 1}, [&](const cv::Range& range) {
    for (int line = range.start; line < range.end; ++line)
      for (int column = 0; column < across; ++column)
        network.rows[line * across + column] =
            edges.between(rows[line], turned(node(column, line)), turned(node(column + 1, line)), false);
  });
  return network;
}

}  // namespace tessera::parquetry

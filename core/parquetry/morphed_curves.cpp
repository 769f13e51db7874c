#include "tessera/parquetry/morphed_curves.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tessera/geometry/inscribed.h"
#include "tessera/geometry/narrow.h"
#include "tessera/parquetry/seams.h"

namespace tessera::parquetry {
namespace {

constexpr double kFlatness = 0.1;   // of the error, what is left to the lines that curves are drawn with
constexpr double kStray = 0.22;     // of an edge's length: so far from its chord it may follow the picture
constexpr double kOn = 1.0;         // px of the edge picture: that near a line is on an edge
constexpr double kFollowed = 0.85;  // share of a line that is to be on edges
constexpr int kSmoothings = 24;     // passes of a kernel of 1 2 1
constexpr double kCorridor = 0.7;   // px of the edge picture, within which they move a point
constexpr double kSharpest = 0.73;  // cosine of 43 degrees: sharper corners break off
constexpr double kSteepest = 0.5;   // cosine of 60 degrees: smooth edges leave their chords by no more

Point unit(Point a) { return length(a) > 0 ? (1 / length(a)) * a : a; }

// The line from a to b along edges of the picture; none where there are no such edges. As for seams, the cheapest
// cut by dynamic programming: here along the chord, half a pixel a step.
class Tracer {
 public:
  explicit Tracer(const EdgePicture& edges) : edges_(edges) {}

  std::optional<Ring> line(Point a, Point b) const {
    const int steps = static_cast<int>(std::ceil(2 * length(b - a) / edges_.px()));
    if (steps < 6) return std::nullopt;
    const Point along = (1.0 / steps) * (b - a), across{-along.y, along.x};
    const auto stray = static_cast<int>(kStray * steps);
    CutCosts costs{2 * stray + 1, {}, {}};
    for (int k = 0; k <= steps; ++k)
      for (int s = -stray; s <= stray; ++s) {
        const bool allowed = std::abs(s) <= std::min(k, steps - k);
        costs.costs.push_back(allowed ? cost_at(a + k * along + s * across) : CutCosts::kNever);
      }
    std::vector<int> cut = cheapest_cut(costs);
    std::vector<double> places;
    int on = 0;
    for (int k = 0; k <= steps; ++k) {
      places.push_back(cut[k] - stray);
      on += edges_.distance(a + k * along + places.back() * across) <= kOn * edges_.px();
    }
    if (on < kFollowed * (steps + 1)) return std::nullopt;
    smooth(places);
    Ring ring{a};
    for (int k = 1; k < steps; ++k) ring.push_back(a + k * along + places[k] * across);
    ring.push_back(b);
    return ring;
  }

 private:
  std::int64_t cost_at(Point p) const {
    constexpr double kFar = 6;  // px
    const double distance = std::min(edges_.distance(p) / edges_.px(), kFar);
    return static_cast<std::int64_t>(std::lround(64 * distance * distance));
  }

  static void smooth(std::vector<double>& places) {
    const std::vector<double> first = places;
    constexpr double kCorridorSteps = 2 * kCorridor;
    for (int pass = 0; pass < kSmoothings; ++pass) {
      std::vector<double> next = places;
      for (std::size_t k = 1; k + 1 < places.size(); ++k)
        next[k] = std::clamp(0.25 * (places[k - 1] + 2 * places[k] + places[k + 1]), first[k] - kCorridorSteps,
                             first[k] + kCorridorSteps);
      places.swap(next);
    }
  }

  const EdgePicture& edges_;
};

// Of triangles made of straight sides: no corner sharper than 43 degrees (curves can do better), and room for a disc.
bool is_sound(Point a, Point b, Point c, double least_width) {
  const Point corners[] = {a, b, c};
  double around = 0;
  for (int i = 0; i < 3; ++i) {
    const Point side = corners[(i + 1) % 3] - corners[i], back = corners[(i + 2) % 3] - corners[i];
    if (dot(side, back) > kSharpest * length(side) * length(back)) return false;
    around += length(side);
  }
  return 2 * std::abs(cross(b - a, c - a)) / around >= least_width;
}

// Whether a piece holds together: its roomiest place, its necks, and that no disc a little larger than the least
// width misses more of it than in a corner of 45 degrees; a little, since whether two corners' parts meet depends on
// how pixels lie. Most miss so little that larger pixels tell.
bool is_wide(const Ring& ring, double width) {
  constexpr double kTail = 1.3, kClearlyNone = 0.7;  // squared radii; pixels add or take some hundredths
  constexpr double kMore = 2;                         // pixels
  const Polygon polygon{ring, {}};
  const auto has_tails = [&](double least, double precision, double most) {
    return largest_thin_part(polygon, least, precision).area > most * width * width / 4;
  };
  const double precision = fair_precision(polygon, 0.01 * width), coarse = 3 * precision;
  if (2 * largest_inscribed(polygon, 0.001 * width).radius < width) return false;
  if (has_tails(width + coarse, coarse, kClearlyNone) && has_tails(width + kMore * precision, precision, kTail))
    return false;
  return narrowest_neck(polygon, width - precision, precision).width >= width - precision;
}

enum class Kind { kSmooth, kFitted, kStraight };

// An edge on its way to be a curve.
struct Side {
  Kind kind = Kind::kSmooth;
  Ring traced;
  SeamEdge edge;
};

class Curves {
 public:
  Curves(const MorphingGrid& grid, const EdgePicture& edges, const CurveLimits& limits)
      : grid_(grid), tracer_(edges), limits_(limits), across_(grid.across()), down_(grid.down()) {
    columns_.resize(static_cast<std::size_t>(across_ + 1) * down_);
    rows_.resize(static_cast<std::size_t>(down_ + 1) * across_);
    diagonals_.resize(static_cast<std::size_t>(across_) * down_);
  }

  MorphedCells cells() {
    each_line([&](int line, bool down) { trace(line, down); });
    each_line([&](int line, bool down) { draw(line, down); });
    cv::parallel_for_({0, down_}, [&](const cv::Range& range) {
      for (int row = range.start; row < range.end; ++row)
        for (int column = 0; column < across_; ++column) add_diagonal(column, row);
    });
    mend();
    return cells_now();
  }

 private:
  struct Cut {
    Diagonal::Way way = Diagonal::Way::kNone;
    Side side;
  };

  template <class Visit>
  void each_line(const Visit& visit) {
    const int lines = across_ + down_ + 2;
    cv::parallel_for_({0, lines}, [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i) i <= across_ ? visit(i, true) : visit(i - across_ - 1, false);
    });
  }

  int sides_of(bool down) const { return down ? down_ : across_; }
  bool is_border(int line, bool down) const { return line == 0 || line == (down ? across_ : down_); }
  Side& side(int line, int k, bool down) { return down ? columns_[line * down_ + k] : rows_[line * across_ + k]; }
  Point vertex(int line, int k, bool down) const { return down ? grid_.vertex(line, k) : grid_.vertex(k, line); }

  void trace(int line, bool down) {
    for (int k = 0; k < sides_of(down); ++k) {
      Side& side = this->side(line, k, down);
      if (is_border(line, down)) {
        side.kind = Kind::kStraight;
      } else if (auto traced = tracer_.line(vertex(line, k, down), vertex(line, k + 1, down))) {
        side.kind = Kind::kFitted;
        side.traced = *std::move(traced);
      }
    }
  }

  // How two traced edges of a line go on into each other; without a second one, (0, 0): as the first does.
  static Point direction_between(const Side& before, const Side& after) {
    constexpr std::size_t kReach = 4;  // steps of half a pixel
    const Ring &a = before.traced, &b = after.traced;
    return unit(b[std::min(kReach, b.size() - 1)] - a[a.size() - 1 - std::min(kReach, a.size() - 1)]);
  }

  void finish(std::vector<Bezier> curves, SeamEdge& edge) const {
    edge.curves = std::move(curves);
    edge.flat = {edge.curves.front()[0]};
    for (const Bezier& curve : edge.curves) flatten(curve, kFlatness * limits_.error, edge.flat);
  }

  void fit(Side& side, Point start, Point end) const {
    side.edge.cut = side.traced;
    finish(fit_beziers(side.traced, (1 - kFlatness) * limits_.error, Joints::kG1, start, end), side.edge);
  }

  void make_straight(Side& side, Point from, Point to) const {
    side.kind = Kind::kStraight;
    side.edge = {};
    finish({straight(from, to)}, side.edge);
    side.edge.flat = {from, to};
  }

  // All edges of a line of the grid: fitted ones first, then the runs between them.
  void draw(int line, bool down) {
    const int sides = sides_of(down);
    const auto is = [&](int k, Kind kind) { return k >= 0 && k < sides && side(line, k, down).kind == kind; };
    for (int k = 0; k < sides; ++k) {
      if (is(k, Kind::kStraight))
        make_straight(side(line, k, down), vertex(line, k, down), vertex(line, k + 1, down));
      if (!is(k, Kind::kFitted)) continue;
      Side& own = side(line, k, down);
      fit(own, is(k - 1, Kind::kFitted) ? direction_between(side(line, k - 1, down), own) : Point{},
          is(k + 1, Kind::kFitted) ? direction_between(own, side(line, k + 1, down)) : Point{});
    }
    for (int first = 0; first < sides; ++first) {
      if (!is(first, Kind::kSmooth)) continue;
      int last = first;
      while (is(last, Kind::kSmooth)) ++last;
      Ring points;
      for (int k = first; k <= last; ++k) points.push_back(vertex(line, k, down));
      Point start, end;
      if (first > 0) start = along_chord(leaving(side(line, first - 1, down)), points[1] - points[0]);
      if (last < sides)
        end = along_chord(entering(side(line, last, down)), points.back() - points[points.size() - 2]);
      const std::vector<Bezier> curves = spline_through(points, start, end);
      for (int k = first; k < last; ++k) {
        side(line, k, down).edge.cut.clear();
        finish({curves[k - first]}, side(line, k, down).edge);
      }
      first = last;
    }
  }

  static Point leaving(const Side& side) { return unit(side.edge.curves.back()[3] - side.edge.curves.back()[2]); }
  static Point entering(const Side& side) { return unit(side.edge.curves.front()[1] - side.edge.curves.front()[0]); }
  static Point along_chord(Point way, Point chord) {
    return dot(way, chord) > kSteepest * length(chord) ? way : Point{};
  }

  void add_diagonal(int column, int row) {
    const Point a = grid_.vertex(column, row), b = grid_.vertex(column + 1, row),
                c = grid_.vertex(column + 1, row + 1), d = grid_.vertex(column, row + 1);
    Cut& cut = diagonals_[row * across_ + column];
    const double width = limits_.least_width;
    std::optional<Ring> falling, rising;
    if (is_sound(a, b, c, width) && is_sound(a, c, d, width)) falling = tracer_.line(a, c);
    if (is_sound(a, b, d, width) && is_sound(b, c, d, width)) rising = tracer_.line(b, d);
    if (!falling && !rising) return;
    cut.way = falling ? Diagonal::Way::kFalling : Diagonal::Way::kRising;
    cut.side.kind = Kind::kFitted;
    cut.side.traced = falling ? *std::move(falling) : *std::move(rising);
    fit(cut.side, {}, {});
  }

  MorphedCells cells_now() const {
    MorphedCells cells;
    cells.network.across = across_, cells.network.down = down_;
    for (const Side& side : columns_) cells.network.columns.push_back(side.edge);
    for (const Side& side : rows_) cells.network.rows.push_back(side.edge);
    for (const Cut& cut : diagonals_) cells.diagonals.push_back({cut.way, cut.side.edge});
    return cells;
  }

  bool is_inside(const Ring& ring) const {
    const Point corner = grid_.vertex(across_, down_);
    return std::all_of(ring.begin(), ring.end(),
                       [&](Point p) { return p.x >= 0 && p.y >= 0 && p.x <= corner.x && p.y <= corner.y; });
  }

  bool can_be_cut(const std::vector<Ring>& outlines) const {
    return std::all_of(outlines.begin(), outlines.end(), [&](const Ring& ring) {
      return signed_area(ring) > 0 && is_inside(ring) && is_simple(ring) && is_wide(ring, limits_.least_width);
    });
  }

  // Makes cells that cannot be cut simpler, until all can; neighbours change with them.
  void mend() {
    std::vector<char> unsure(diagonals_.size(), 1), bad(diagonals_.size());
    for (bool again = true; again;) {
      again = false;
      const MorphedCells now = cells_now();
      cv::parallel_for_({0, static_cast<int>(unsure.size())}, [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i)
          bad[i] = unsure[i] && !can_be_cut(now.outlines(i % across_, i / across_));
      });
      std::fill(unsure.begin(), unsure.end(), 0);
      std::vector<char> changed_columns(across_ + 1, 0), changed_rows(down_ + 1, 0);
      for (int i = 0; i < static_cast<int>(bad.size()); ++i)
        if (bad[i]) again |= simplify(i % across_, i / across_, unsure, changed_columns, changed_rows);
      each_line([&](int line, bool down) {
        if ((down ? changed_columns : changed_rows)[line]) draw(line, down);
      });
      for (int row = 0; row < down_; ++row)
        for (int column = 0; column < across_; ++column)
          if (changed_columns[column] || changed_columns[column + 1] || changed_rows[row] || changed_rows[row + 1])
            unsure[row * across_ + column] = 1;
    }
  }

  // A curved diagonal becomes straight, a straight one goes; else the most bent side becomes straight. False where
  // there is nothing left to do.
  bool simplify(int column, int row, std::vector<char>& unsure, std::vector<char>& columns, std::vector<char>& rows) {
    Cut& cut = diagonals_[row * across_ + column];
    if (cut.way != Diagonal::Way::kNone) {
      if (cut.side.kind == Kind::kFitted)
        make_straight(cut.side, cut.side.traced.front(), cut.side.traced.back());
      else
        cut = {};
      unsure[row * across_ + column] = 1;
      return true;
    }
    const std::pair<int, bool> lines[] = {{column, true}, {column + 1, true}, {row, false}, {row + 1, false}};
    Side* most = nullptr;
    double bent = 0;
    for (const auto& [line, down] : lines) {
      Side& side = this->side(line, down ? row : column, down);
      const double own = bend_of(side.edge.flat);
      if (side.kind == Kind::kStraight || (most && own <= bent)) continue;
      most = &side, bent = own;
    }
    if (!most) return false;
    most->kind = Kind::kStraight;
    for (const auto& [line, down] : lines)
      if (most == &this->side(line, down ? row : column, down)) (down ? columns : rows)[line] = 1;
    return true;
  }

  static double bend_of(const Ring& line) {
    double bend = 0;
    for (const Point p : line) bend = std::max(bend, std::abs(cross(line.back() - line.front(), p - line.front())));
    return bend / length(line.back() - line.front());
  }

  const MorphingGrid& grid_;
  Tracer tracer_;
  CurveLimits limits_;
  int across_, down_;
  std::vector<Side> columns_, rows_;
  std::vector<Cut> diagonals_;
};

}  // namespace

std::vector<Ring> MorphedCells::outlines(int column, int row) const {
  const Diagonal& cut = diagonal(column, row);
  if (cut.way == Diagonal::Way::kNone) return {network.outline(column, row)};
  const bool falling = cut.way == Diagonal::Way::kFalling;
  const Ring &top = network.row(row, column).flat, &right = network.column(column + 1, row).flat,
             &bottom = network.row(row + 1, column).flat, &left = network.column(column, row).flat,
             &diagonal = cut.edge.flat;
  std::vector<Ring> rings(2);
  append(top, false, rings[0]);
  if (falling) append(right, false, rings[0]);
  append(diagonal, falling, rings[0]);
  if (!falling) append(left, true, rings[0]);
  append(falling ? diagonal : right, false, rings[1]);
  append(bottom, true, rings[1]);
  append(falling ? left : diagonal, true, rings[1]);
  return rings;
}

MorphedCells cells_of(const MorphingGrid& grid, const EdgePicture& edges, const CurveLimits& limits) {
  return Curves(grid, edges, limits).cells();
}

}  // namespace tessera::parquetry

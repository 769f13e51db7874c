#include "tessera/geometry/bezier.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tessera {
namespace {

constexpr int kNewtonSteps = 4;
constexpr int kBetween = 10;     // parts of the curve between two points of the line, whose ends are looked at
constexpr double kHopeless = 4;  // times the error allowed: beyond that, better parameters do not help

Point unit(Point a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : Point{};
}

struct Weights {  // Bernstein polynomials
  double b0, b1, b2, b3;
};
Weights weights(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
}

double distance_to_segment(Point p, Point a, Point b) {
  const Point way = b - a;
  const double size = dot(way, way);
  const double share = size > 0 ? std::clamp(dot(p - a, way) / size, 0.0, 1.0) : 0.0;
  return length(p - a - share * way);
}

class Fit {
 public:
  Fit(const Ring& line, double error, Joints joints) : line_(line), error_(error), joints_(joints) {}

  // Curves from point `first` to `last`.
  void along(std::size_t first, std::size_t last, Point start, Point end) {
    if (last - first == 1) {
      curves_.push_back(short_curve(line_[first], line_[last], start, end));
      return;
    }
    std::vector<double> t = chord_lengths(first, last);
    Worst worst{};
    for (int step = 0; step <= kNewtonSteps; ++step) {
      const Bezier curve = joints_ == Joints::kG1 ? with_directions(first, t, start, end) : free_curve(first, t);
      worst = worst_of(curve, first, t);
      if (worst.distance <= error_) {
        curves_.push_back(curve);
        return;
      }
      if (worst.distance > kHopeless * error_ || !improve(curve, first, t)) break;
    }
    const std::size_t split = std::clamp(worst.point, first + 1, last - 1);
    const Point way = direction_at(split);
    along(first, split, start, way);
    along(split, last, way, end);
  }

  // Of the line at a point, from those two before and after it.
  Point direction_at(std::size_t i) const {
    const std::size_t before = i >= 2 ? i - 2 : 0, after = std::min(i + 2, line_.size() - 1);
    const Point way = unit(line_[after] - line_[before]);
    return way == Point{} ? unit(line_[std::min(i + 1, line_.size() - 1)] - line_[i > 0 ? i - 1 : 0]) : way;
  }

  std::vector<Bezier> take() { return std::move(curves_); }

 private:
  struct Worst {
    double distance = 0;
    std::size_t point = 0;
  };

  std::vector<double> chord_lengths(std::size_t first, std::size_t last) const {
    std::vector<double> t{0};
    for (std::size_t i = first + 1; i <= last; ++i) t.push_back(t.back() + length(line_[i] - line_[i - 1]));
    for (double& v : t) v /= t.back();
    t.back() = 1;
    return t;
  }

  // Between two points nothing can be measured: the control points stay so near that the curve does.
  Bezier short_curve(Point from, Point to, Point start, Point end) const {
    if (joints_ == Joints::kG0) return straight(from, to);
    const double reach = std::min(length(to - from) / 3, error_);
    return {from, from + reach * start, to - reach * end, to};
  }

  // Schneider's: the control points' distances from the ends are what is not known.
  Bezier with_directions(std::size_t first, const std::vector<double>& t, Point start, Point end) const {
    const Point from = line_[first], to = line_[first + t.size() - 1];
    double c11 = 0, c12 = 0, c22 = 0, x1 = 0, x2 = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const Weights w = weights(t[i]);
      const Point a = w.b1 * start, b = -w.b2 * end;
      const Point rest = line_[first + i] - (w.b0 + w.b1) * from - (w.b2 + w.b3) * to;
      c11 += dot(a, a), c12 += dot(a, b), c22 += dot(b, b);
      x1 += dot(a, rest), x2 += dot(b, rest);
    }
    const double determinant = c11 * c22 - c12 * c12, chord = length(to - from);
    double near = 0, far = 0;
    if (determinant > 1e-12 * c11 * c22) {
      near = (x1 * c22 - x2 * c12) / determinant;
      far = (c11 * x2 - c12 * x1) / determinant;
    }
    // Wu and Barsky's rule of thumb where that makes a loop or a cusp.
    const auto sound = [&](double reach) { return reach > 1e-3 * chord && reach < 3 * chord; };
    if (!sound(near) || !sound(far)) near = far = chord / 3;
    return {from, from + near * start, to - far * end, to};
  }

  // Both control points are free.
  Bezier free_curve(std::size_t first, const std::vector<double>& t) const {
    const Point from = line_[first], to = line_[first + t.size() - 1];
    double c11 = 0, c12 = 0, c22 = 0;
    Point x1, x2;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const Weights w = weights(t[i]);
      const Point rest = line_[first + i] - w.b0 * from - w.b3 * to;
      c11 += w.b1 * w.b1, c12 += w.b1 * w.b2, c22 += w.b2 * w.b2;
      x1 += w.b1 * rest, x2 += w.b2 * rest;
    }
    const double determinant = c11 * c22 - c12 * c12;
    if (!(determinant > 1e-9 * c11 * c22)) return straight(from, to);
    return {from, (1 / determinant) * (c22 * x1 - c12 * x2), (1 / determinant) * (c11 * x2 - c12 * x1), to};
  }

  // The larger of the line's points' distances to the curve and of those of the curve, between them, to the line.
  Worst worst_of(const Bezier& curve, std::size_t first, const std::vector<double>& t) const {
    Worst worst{0, first};
    const auto count = [&](double distance, std::size_t point) {
      if (distance > worst.distance) worst = {distance, point};
    };
    const std::size_t last = first + t.size() - 1;
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
      const std::size_t point = first + i;
      count(length(point_at(curve, t[i]) - line_[point]), point);
      for (int k = 1; k < kBetween; ++k) {
        const Point between = point_at(curve, t[i] + k * (t[i + 1] - t[i]) / kBetween);
        double nearest = distance_to_segment(between, line_[point], line_[point + 1]);
        if (point > first) nearest = std::min(nearest, distance_to_segment(between, line_[point - 1], line_[point]));
        if (point + 1 < last)
          nearest = std::min(nearest, distance_to_segment(between, line_[point + 1], line_[point + 2]));
        count(nearest, i > 0 ? point : point + 1);
      }
    }
    return worst;
  }

  // Moves each parameter towards the curve's point nearest to its own; false where they would change their order.
  bool improve(const Bezier& c, std::size_t first, std::vector<double>& t) const {
    const Point d0 = 3.0 * (c[1] - c[0]), d1 = 3.0 * (c[2] - c[1]), d2 = 3.0 * (c[3] - c[2]);
    for (std::size_t i = 1; i + 1 < t.size(); ++i) {
      const double s = 1 - t[i];
      const Point off = point_at(c, t[i]) - line_[first + i];
      const Point speed = s * s * d0 + 2 * s * t[i] * d1 + t[i] * t[i] * d2;
      const Point bend = 2 * s * (d1 - d0) + 2 * t[i] * (d2 - d1);
      const double slope = dot(speed, speed) + dot(off, bend);
      if (slope > 0) t[i] -= dot(off, speed) / slope;
    }
    return std::is_sorted(t.begin(), t.end());
  }

  const Ring& line_;
  double error_;
  Joints joints_;
  std::vector<Bezier> curves_;
};

}  // namespace

Point point_at(const Bezier& curve, double t) {
  const Weights w = weights(t);
  return w.b0 * curve[0] + w.b1 * curve[1] + w.b2 * curve[2] + w.b3 * curve[3];
}

Bezier straight(Point from, Point to) {
  return {from, from + (1.0 / 3) * (to - from), to - (1.0 / 3) * (to - from), to};
}

std::vector<Bezier> fit_beziers(const Ring& line, double error, Joints joints, Point start, Point end) {
  assert(line.size() >= 2 && error > 0);
  Fit fit(line, error, joints);
  if (start == Point{}) start = fit.direction_at(0);
  if (end == Point{}) end = fit.direction_at(line.size() - 1);
  fit.along(0, line.size() - 1, start, end);
  return fit.take();
}

std::vector<Bezier> spline_through(const Ring& points, Point start, Point end) {
  assert(points.size() >= 2);
  const std::size_t last = points.size() - 1;
  std::vector<double> h;
  for (std::size_t i = 0; i < last; ++i) h.push_back(length(points[i + 1] - points[i]));
  const auto slope = [&](std::size_t i) { return (1 / h[i]) * (points[i + 1] - points[i]); };
  // below[i] d[i - 1] + own[i] d[i] + above[i] d[i + 1] = right[i] for the derivatives d.
  std::vector<double> below(last + 1, 0), own(last + 1, 1), above(last + 1, 0);
  Ring right(last + 1);
  right[0] = start, right[last] = end;
  if (start == Point{}) own[0] = 2, above[0] = 1, right[0] = 3.0 * slope(0);
  if (end == Point{}) below[last] = 1, own[last] = 2, right[last] = 3.0 * slope(last - 1);
  for (std::size_t i = 1; i < last; ++i) {
    below[i] = h[i], own[i] = 2 * (h[i - 1] + h[i]), above[i] = h[i - 1];
    right[i] = 3.0 * (h[i] * slope(i - 1) + h[i - 1] * slope(i));
  }
  for (std::size_t i = 1; i <= last; ++i) {
    const double share = below[i] / own[i - 1];
    own[i] -= share * above[i - 1];
    right[i] -= share * right[i - 1];
  }
  Ring d(last + 1);
  d[last] = (1 / own[last]) * right[last];
  for (std::size_t i = last; i-- > 0;) d[i] = (1 / own[i]) * (right[i] - above[i] * d[i + 1]);
  std::vector<Bezier> curves;
  for (std::size_t i = 0; i < last; ++i)
    curves.push_back(
        {points[i], points[i] + (h[i] / 3) * d[i], points[i + 1] - (h[i] / 3) * d[i + 1], points[i + 1]});
  return curves;
}

void flatten(const Bezier& c, double tolerance, Ring& line) {
  assert(tolerance > 0);
  // A chord over h of the parameter is off by h^2 / 8 of the second derivative at most, and that is the larger of its
  // ends'.
  const double bend = 6 * std::max(length(c[0] - 2 * c[1] + c[2]), length(c[1] - 2 * c[2] + c[3]));
  const int parts = std::max(1, static_cast<int>(std::ceil(std::sqrt(bend / (8 * tolerance)))));
  for (int i = 1; i < parts; ++i) line.push_back(point_at(c, static_cast<double>(i) / parts));
  line.push_back(c[3]);
}

}  // namespace tessera

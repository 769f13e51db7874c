#include "tessera/parquetry/registration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tessera::parquetry {
namespace {

Point mean_of(const std::vector<Point>& points) {
  Point sum;
  for (const Point p : points) sum += p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

// With both about their means: complex numbers a = sum(conj(f) t) / sum |f|^2.
Affine similarity(const std::vector<Point>& from, Point from_mean, const std::vector<Point>& to, Point to_mean) {
  double along = 0, across = 0, squares = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Point f = from[i] - from_mean, t = to[i] - to_mean;
    along += dot(f, t);
    across += cross(f, t);
    squares += dot(f, f);
  }
  const double c = squares > 0 ? along / squares : 1, s = squares > 0 ? across / squares : 0;
  return {c, -s, s, c, {}};
}

// The normal equations of both rows. Places on one line leave it open; the similarity then is what can be said.
Affine affine(const std::vector<Point>& from, Point from_mean, const std::vector<Point>& to, Point to_mean) {
  double xx = 0, xy = 0, yy = 0;
  Point by_x, by_y;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Point f = from[i] - from_mean, t = to[i] - to_mean;
    xx += f.x * f.x, xy += f.x * f.y, yy += f.y * f.y;
    by_x += f.x * t;
    by_y += f.y * t;
  }
  const double determinant = xx * yy - xy * xy;
  if (determinant <= 1e-6 * (xx + yy) * (xx + yy)) return similarity(from, from_mean, to, to_mean);
  const auto solve = [&](double x, double y) {
    return Point{(x * yy - y * xy) / determinant, (y * xx - x * xy) / determinant};
  };
  const Point row_x = solve(by_x.x, by_y.x), row_y = solve(by_x.y, by_y.y);
  return {row_x.x, row_x.y, row_y.x, row_y.y, {}};
}

}  // namespace

Fitted fit(const std::vector<Point>& from, const std::vector<Point>& to, Registration kind) {
  assert(from.size() == to.size() && from.size() >= 2);
  const Point from_mean = mean_of(from), to_mean = mean_of(to);
  Fitted fitted;
  fitted.map = (kind == Registration::kAffine ? affine : similarity)(from, from_mean, to, to_mean);
  fitted.map.at = to_mean - fitted.map(from_mean);
  double squares = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    fitted.residuals.push_back(length(fitted.map(from[i]) - to[i]));
    squares += fitted.residuals.back() * fitted.residuals.back();
  }
  fitted.rms = std::sqrt(squares / static_cast<double>(from.size()));
  return fitted;
}

std::optional<Fitted> fit_unordered(const std::vector<Point>& from, const std::vector<Point>& to, Registration kind) {
  // Two of each fix a similarity. Scans have been made mm already, so that it hardly resizes.
  constexpr double kResized = 0.05, kAlike = 0.05;
  const auto partners_of = [&](const Affine& map) {
    std::vector<Point> partners;
    for (const Point p : to)
      partners.push_back(*std::min_element(
          from.begin(), from.end(), [&](Point a, Point b) { return length(map(a) - p) < length(map(b) - p); }));
    return partners;
  };
  const auto repeats = [](const std::vector<Point>& points) {
    for (auto p = points.begin(); p != points.end(); ++p)
      if (std::find(points.begin(), p, *p) != p) return true;
    return false;
  };
  std::optional<Fitted> best;
  double best_turn = 0;
  for (const Point a : from)
    for (const Point b : from)
      for (std::size_t m = 1; m < to.size(); ++m) {
        const double apart = length(to[m] - to[0]);
        if (a == b || std::abs(length(b - a) - apart) > kResized * apart) continue;
        const std::vector<Point> partners = partners_of(fit({a, b}, {to[0], to[m]}, Registration::kSimilarity).map);
        if (repeats(partners)) continue;
        const Fitted fitted = fit(partners, to, kind);
        const double turn = std::abs(fitted.map.yx) + std::max(0.0, -fitted.map.xx);
        if (!best || fitted.rms < best->rms - kAlike || (fitted.rms < best->rms + kAlike && turn < best_turn)) {
          best = fitted;
          best_turn = turn;
        }
      }
  return best;
}

Result<void> check_fit(const Fitted& fitted, const std::string& panel) {
  if (fitted.rms <= kWorstFitMm) return {};
  std::string each;
  for (const double residual : fitted.residuals) each += fmt::format("{}{:.2f}", each.empty() ? "" : ", ", residual);
  return fail(StatusCode::kInvalidInput, panel,
              fmt::format("does not lie on the machine as its marks say: they are off by {:.2f} mm rms ({} mm), "
                          "expected at most {} mm",
                          fitted.rms, each, kWorstFitMm));
}

}  // namespace tessera::parquetry

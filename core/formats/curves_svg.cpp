#include <algorithm>
#include <cmath>

#include "tessera/formats/formats.h"
#include "tessera/formats/plot.h"
#include "tessera/formats/text.h"

namespace tessera {
namespace {

using namespace plot;

constexpr double kSeen = 0.25;  // px: a nearer point is not drawn

struct Axes {
  Axis x, y;
  Point at(Point p) const { return {x.x(p.x), y.y(p.y)}; }
};

Axes axes_around(const Curves& curves) {
  std::vector<double> xs, ys = {0};
  const auto take = [&](Point p) { xs.push_back(p.x), ys.push_back(p.y); };
  for (const auto& series : curves.series) std::for_each(series.points.begin(), series.points.end(), take);
  for (const auto& mark : curves.marks) take(mark.at);
  if (xs.empty()) xs = {1};
  const auto [left, right] = std::minmax_element(xs.begin(), xs.end());
  const auto [low, high] = std::minmax_element(ys.begin(), ys.end());
  return {curves.logarithmic ? logarithmic_axis(*left, *right) : linear_axis(*left, *right),
          linear_axis(*low, *high)};
}

void append_ticks(std::string& out, const Axis& axis) {
  for (const double value : axis.ticks()) {
    append_line(out, {axis.x(value), kTop}, {axis.x(value), kBottom + 4}, "#e2e2e2");
    std::string label;
    append_number(label, value);
    append_text(out, {axis.x(value), kBottom + 18}, " text-anchor=\"middle\"", label);
  }
}

void append_curve(std::string& out, const std::vector<Point>& points, const Axes& axes, const char* colour) {
  if (points.empty()) return;
  Point last = axes.at(points.front());
  out += "<path d=\"M";
  append_point(out, last, ' ');
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Point p = axes.at(points[k]);
    if (length(p - last) < kSeen && k + 1 < points.size()) continue;
    out += 'L';
    append_point(out, last = p, ' ');
  }
  out += "\" fill=\"none\" stroke-width=\"2\" stroke-linejoin=\"round\" stroke=\"";
  out += colour;
  out += "\"/>\n";
}

// Dashes from the left to the place and down, a dot, and what it is.
void append_mark(std::string& out, const Curves::Mark& mark, const Axes& axes) {
  const Point p = axes.at(mark.at);
  out += "<path d=\"M";
  append_point(out, {kLeft, p.y}, ' ');
  out += 'L';
  append_point(out, p, ' ');
  out += 'L';
  append_point(out, {p.x, kBottom}, ' ');
  out += "\" fill=\"none\" stroke-dasharray=\"4 3\" stroke=\"#6b6b6b\"/>\n<circle cx=\"";
  append_number(out, p.x);
  out += "\" cy=\"";
  append_number(out, p.y);
  out += "\" r=\"4\"/>\n";
  // Beside the dot where there is nothing of a rising curve: above it to the left, or, near that edge, below.
  const bool near_edge = p.x < kLeft + 140;
  append_text(out, {p.x + (near_edge ? 10 : -10), p.y + (near_edge ? 14 : -7)},
              near_edge ? "" : " text-anchor=\"end\"", mark.label);
}

}  // namespace

std::string write_curves_svg(const Curves& curves) {
  std::string drawn;
  const Axes axes = axes_around(curves);
  append_ticks(drawn, axes.x);
  append_value_axis(drawn, axes.y);
  for (std::size_t s = 0; s < curves.series.size(); ++s) {
    append_curve(drawn, curves.series[s].points, axes, colour_of(s));
    append_legend_entry(drawn, s, curves.series[s].name);
  }
  for (const auto& mark : curves.marks) append_mark(drawn, mark, axes);
  return framed(curves.title, curves.x_label, curves.y_label, drawn);
}

}  // namespace tessera

#include "tessera/formats/plot.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tessera/formats/text.h"

namespace tessera::plot {
namespace {

constexpr double kMostTicks = 6;
constexpr double kRound[] = {1, 2, 5};
constexpr const char* kColours[] = {"#2f5d8a", "#d08c3c", "#5b8c5a", "#a4505a", "#7a6a9b", "#6b6b6b"};

// The least of 1, 2, 5, 10, 20 ... times a power of ten with which kMostTicks steps reach `top`.
double tick_step(double top) {
  const double least = top / kMostTicks;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : kRound)
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

}  // namespace

double Axis::part(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

std::vector<double> Axis::ticks() const {
  std::vector<double> ticks;
  if (!logarithmic) {
    const auto first = std::lround(low / step), last = std::lround(high / step);
    for (auto tick = first; tick <= last; ++tick) ticks.push_back(static_cast<double>(tick) * step);
    return ticks;
  }
  const int first = static_cast<int>(std::floor(std::log10(low))) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(high))) + 1;
  for (int power = first; power <= last; ++power)
    for (const double factor : kRound) {
      const double tick = factor * std::pow(10, power);
      if (tick > low * 0.999 && tick < high * 1.001) ticks.push_back(tick);
    }
  return ticks;
}

Axis linear_axis(double least, double most) {
  least = std::min(least, 0.0), most = std::max(most, 0.0);
  Axis axis;
  if (const double furthest = std::max(-least, most); furthest > 0) axis.step = tick_step(furthest);
  axis.low = axis.step * std::floor(least / axis.step);
  axis.high = axis.step * std::ceil(most / axis.step);
  if (axis.high == axis.low) axis.high += axis.step;
  return axis;
}

Axis logarithmic_axis(double least, double most) {
  Axis axis;
  axis.logarithmic = true;
  axis.low = std::pow(10, std::floor(std::log10(least)) - 1);  // below it for certain
  axis.high = std::pow(10, std::floor(std::log10(most)) + 1);
  const std::vector<double> round = axis.ticks();
  axis.low = *(std::upper_bound(round.begin(), round.end(), least) - 1);
  axis.high = *std::upper_bound(round.begin(), round.end() - 1, most);
  return axis;
}

const char* colour_of(std::size_t series) { return kColours[series % std::size(kColours)]; }

void append_text(std::string& out, Point p, const char* attributes, std::string_view text) {
  out += "<text x=\"";
  append_number(out, p.x);
  out += "\" y=\"";
  append_number(out, p.y);
  out += '"';
  out += attributes;
  out += '>';
  append_xml(out, text);
  out += "</text>\n";
}

void append_rect(std::string& out, Point corner, double width, double height, const char* fill) {
  out += "<rect x=\"";
  append_number(out, corner.x);
  out += "\" y=\"";
  append_number(out, corner.y);
  out += "\" width=\"";
  append_number(out, width);
  out += "\" height=\"";
  append_number(out, height);
  out += "\" fill=\"";
  out += fill;
  out += "\"/>\n";
}

void append_line(std::string& out, Point a, Point b, const char* stroke) {
  out += "<path d=\"M";
  append_point(out, a, ' ');
  out += 'L';
  append_point(out, b, ' ');
  out += "\" stroke=\"";
  out += stroke;
  out += "\"/>\n";
}

void append_value_axis(std::string& out, const Axis& axis) {
  const double base = std::max(axis.low, 0.0);
  for (const double value : axis.ticks()) {
    const double y = axis.y(value);
    append_line(out, {kLeft, y}, {kRight, y}, value == base ? "#333333" : "#e2e2e2");
    std::string label;
    append_number(label, value);
    append_text(out, {kLeft - 8, y + 4}, " text-anchor=\"end\"", label);
  }
}

void append_legend_entry(std::string& out, std::size_t series, std::string_view name) {
  constexpr double kEntry = 150;
  const double x = kLeft + kEntry * static_cast<double>(series);
  append_rect(out, {x, 46}, 12, 12, colour_of(series));
  append_text(out, {x + 18, 56}, "", name);
}

std::string framed(const std::string& title, const std::string& x_label, const std::string& y_label,
                   const std::string& drawn) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" "
      "width=\"";
  append_number(out, kWidth);
  out += "px\" height=\"";
  append_number(out, kHeight);
  out += "px\" viewBox=\"0 0 ";
  append_point(out, {kWidth, kHeight}, ' ');
  out += "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#333333\">\n";
  append_rect(out, {}, kWidth, kHeight, "#ffffff");
  out += drawn;
  append_text(out, {kLeft, 28}, " font-size=\"16\" font-weight=\"bold\"", title);
  append_text(out, {(kLeft + kRight) / 2, kBottom + 48}, " text-anchor=\"middle\"", x_label);
  out += "<g transform=\"translate(20 ";
  append_number(out, (kTop + kBottom) / 2);
  out += ") rotate(-90)\">\n";
  append_text(out, {}, " text-anchor=\"middle\"", y_label);
  out += "</g>\n</svg>\n";
  return out;
}

}  // namespace tessera::plot

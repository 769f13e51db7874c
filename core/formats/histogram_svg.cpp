#include <algorithm>
#include <cassert>
#include <cmath>

#include "tessera/formats/formats.h"
#include "tessera/formats/text.h"

namespace tessera {
namespace {

// The plot area within the drawing, in px.
constexpr double kWidth = 720, kHeight = 440;
constexpr double kLeft = 72, kRight = 696, kTop = 76, kBottom = 372;
constexpr double kMostBinLabels = 16, kMostTicks = 6;
constexpr const char* kColours[] = {"#2f5d8a", "#d08c3c", "#5b8c5a", "#a4505a", "#7a6a9b", "#6b6b6b"};

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

// The least of 1, 2, 5, 10, 20 ... times a power of ten with which kMostTicks steps reach `top`.
double tick_step(double top) {
  const double least = top / kMostTicks;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

struct Axis {
  double step, top;  // top is a whole number of steps

  explicit Axis(const Histogram& histogram) {
    double highest = 0;
    for (const auto& series : histogram.series)
      for (const double value : series.values) highest = std::max(highest, value);
    step = highest > 0 ? tick_step(highest) : 1;
    top = step * std::max(1.0, std::ceil(highest / step));
  }
  double y(double value) const { return kBottom - (kBottom - kTop) * value / top; }
};

void append_value_axis(std::string& out, const Axis& axis) {
  const int ticks = static_cast<int>(std::lround(axis.top / axis.step));
  for (int tick = 0; tick <= ticks; ++tick) {
    const double value = tick * axis.step, y = axis.y(value);
    append_line(out, {kLeft, y}, {kRight, y}, tick == 0 ? "#333333" : "#e2e2e2");
    std::string label;
    append_number(label, value);
    append_text(out, {kLeft - 8, y + 4}, " text-anchor=\"end\"", label);
  }
}

void append_bars(std::string& out, const Histogram& histogram, const Axis& axis) {
  const double slot = (kRight - kLeft) / static_cast<double>(histogram.bins.size());
  const double bar = 0.8 * slot / static_cast<double>(histogram.series.size());
  for (std::size_t s = 0; s < histogram.series.size(); ++s) {
    const auto& values = histogram.series[s].values;
    assert(values.size() == histogram.bins.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double x = kLeft + slot * (static_cast<double>(k) + 0.1) + bar * static_cast<double>(s);
      if (values[k] > 0) append_rect(out, {x, axis.y(values[k])}, bar, kBottom - axis.y(values[k]), colour_of(s));
    }
  }
}

// Every label where they fit, else every second, third and so on.
void append_bin_labels(std::string& out, const std::vector<std::string>& bins) {
  const double slot = (kRight - kLeft) / static_cast<double>(bins.size());
  const auto every = static_cast<std::size_t>(std::ceil(static_cast<double>(bins.size()) / kMostBinLabels));
  for (std::size_t k = 0; k < bins.size(); k += every)
    append_text(out, {kLeft + slot * (static_cast<double>(k) + 0.5), kBottom + 18}, " text-anchor=\"middle\"",
                bins[k]);
}

void append_legend(std::string& out, const Histogram& histogram) {
  constexpr double kEntry = 150;
  for (std::size_t s = 0; s < histogram.series.size(); ++s) {
    const double x = kLeft + kEntry * static_cast<double>(s);
    append_rect(out, {x, 46}, 12, 12, colour_of(s));
    append_text(out, {x + 18, 56}, "", histogram.series[s].name);
  }
}

void append_titles(std::string& out, const Histogram& histogram) {
  append_text(out, {kLeft, 28}, " font-size=\"16\" font-weight=\"bold\"", histogram.title);
  append_text(out, {(kLeft + kRight) / 2, kBottom + 48}, " text-anchor=\"middle\"", histogram.x_label);
  out += "<g transform=\"translate(20 ";
  append_number(out, (kTop + kBottom) / 2);
  out += ") rotate(-90)\">\n";
  append_text(out, {}, " text-anchor=\"middle\"", histogram.y_label);
  out += "</g>\n";
}

}  // namespace

std::string write_histogram_svg(const Histogram& histogram) {
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
  const Axis axis(histogram);
  append_value_axis(out, axis);
  append_bars(out, histogram, axis);
  append_bin_labels(out, histogram.bins);
  append_legend(out, histogram);
  append_titles(out, histogram);
  out += "</svg>\n";
  return out;
}

}  // namespace tessera

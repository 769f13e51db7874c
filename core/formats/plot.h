// What plots in SVG share: the drawing, texts, axes, a legend. All append to `out`; places are in px of the drawing.
#pragma once

#include <string>
#include <string_view>

#include "tessera/formats/formats.h"

namespace tessera::plot {

// The drawing, and the area of the values within it, in px.
constexpr double kWidth = 720, kHeight = 440;
constexpr double kLeft = 72, kRight = 696, kTop = 76, kBottom = 372;

// An axis with round ticks. Linear: `step` apart, of which `low` and `high` are whole multiples. Logarithmic: `low`
// and `high` are 1, 2 or 5 times a power of ten, and ticks are all such numbers between them.
struct Axis {
  double low = 0, high = 1, step = 1;
  bool logarithmic = false;

  double part(double value) const;  // of the way from low to high
  double x(double value) const { return kLeft + (kRight - kLeft) * part(value); }
  double y(double value) const { return kBottom - (kBottom - kTop) * part(value); }
  std::vector<double> ticks() const;
};
// The least axes around these values and, for the linear one, 0. At most 7 ticks on one side of 0; logarithms want
// values above 0.
Axis linear_axis(double least, double most);
Axis logarithmic_axis(double least, double most);

const char* colour_of(std::size_t series);
void append_text(std::string& out, Point p, const char* attributes, std::string_view text);
void append_rect(std::string& out, Point corner, double width, double height, const char* fill);
void append_line(std::string& out, Point a, Point b, const char* stroke);
// Lines across at the ticks with their values to the left; that of 0, or the lowest, is dark.
void append_value_axis(std::string& out, const Axis& axis);
void append_legend_entry(std::string& out, std::size_t series, std::string_view name);
// The whole file: title and the axes' names around what the others have drawn.
std::string framed(const std::string& title, const std::string& x_label, const std::string& y_label,
                   const std::string& drawn);

}  // namespace tessera::plot

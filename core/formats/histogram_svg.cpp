#include <algorithm>
#include <cassert>
#include <cmath>

#include "tessera/formats/formats.h"
#include "tessera/formats/plot.h"

namespace tessera {
namespace {

using namespace plot;

constexpr double kMostBinLabels = 16;

double highest_of(const Histogram& histogram) {
  double highest = 0;
  for (const auto& series : histogram.series)
    for (const double value : series.values) highest = std::max(highest, value);
  return highest;
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

}  // namespace

std::string write_histogram_svg(const Histogram& histogram) {
  std::string drawn;
  const Axis axis = linear_axis(0, highest_of(histogram));
  append_value_axis(drawn, axis);
  append_bars(drawn, histogram, axis);
  append_bin_labels(drawn, histogram.bins);
  for (std::size_t s = 0; s < histogram.series.size(); ++s) append_legend_entry(drawn, s, histogram.series[s].name);
  return framed(histogram.title, histogram.x_label, histogram.y_label, drawn);
}

}  // namespace tessera

#include "tessera/job/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace tessera {

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double variation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  if (mean == 0) return 0;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size())) / mean;
}

Histogram count_histogram(const std::vector<CountSeries>& series) {
  std::optional<int> least, largest;
  for (const CountSeries& s : series) {
    for (const int value : s.values) {
      least = std::min(least.value_or(value), value);
      largest = std::max(largest.value_or(value), value);
    }
  }
  Histogram histogram;
  const int first = least.value_or(0), last = largest.value_or(0);
  for (int value = first; value <= last; ++value) histogram.bins.push_back(fmt::format("{}", value));
  for (const CountSeries& s : series) {
    std::vector<double> counts(histogram.bins.size());
    for (const int value : s.values) ++counts[static_cast<std::size_t>(value - first)];
    histogram.series.push_back({s.name, std::move(counts)});
  }
  return histogram;
}

Histogram value_histogram(const std::string& name, const std::vector<double>& values, int bins) {
  const double largest = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  const double width = largest > 0 ? largest / bins : 1;
  Histogram histogram;
  for (int bin = 0; bin < bins; ++bin) histogram.bins.push_back(fmt::format("{:.3g}", (bin + 0.5) * width));
  std::vector<double> counts(histogram.bins.size());
  for (const double value : values) ++counts[static_cast<std::size_t>(std::min(value / width, bins - 1.0))];
  histogram.series.push_back({name, std::move(counts)});
  return histogram;
}

std::vector<Point> cumulative(const std::vector<double>& values, const std::vector<double>& weights) {
  if (values.empty()) return {};
  std::vector<Point> sorted;  // value, weight
  for (std::size_t i = 0; i < values.size(); ++i) sorted.push_back({values[i], weights.empty() ? 1 : weights[i]});
  std::sort(sorted.begin(), sorted.end(), [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  double whole = 0, below = 0;
  for (const Point& p : sorted) whole += p.y;
  std::vector<Point> points = {{sorted.front().x, 0}};
  for (const Point& p : sorted) {
    points.push_back({p.x, 100 * (below + p.y / 2) / whole});
    below += p.y;
  }
  points.push_back({sorted.back().x, 100});
  return points;
}

}  // namespace tessera

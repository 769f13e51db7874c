// Small statistics for reports and plots.
#pragma once

#include <string>
#include <vector>

#include "tessera/formats/formats.h"

namespace tessera {

double mean_of(const std::vector<double>& values);       // 0 of none
double variation_of(const std::vector<double>& values);  // standard deviation / mean; 0 of none

struct CountSeries {
  std::string name;
  std::vector<int> values;
};

// How often each whole number occurs, from the least to the largest of all series; bins and series only.
Histogram count_histogram(const std::vector<CountSeries>& series);
// How many values, none negative, fall into each of `bins` equal bins from 0 to the largest; a bin is labelled with
// its middle, and the last one takes the largest value in.
Histogram value_histogram(const std::string& name, const std::vector<double>& values, int bins);

// What percentage of all weight is that of values up to each one: (value, percent) from the least value to the
// largest, neither ever falling, from 0 to 100. Half of a value's weight counts at the value itself. Weights, one a
// value, are above 0; none stands for equal ones. Without values there are no points.
std::vector<Point> cumulative(const std::vector<double>& values, const std::vector<double>& weights = {});

}  // namespace tessera

#include "tessera/pebbles/watershed.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tessera::pebbles {
namespace {

// The lowest pixel among (y, x) and its four neighbours, as an index.
int downhill(const cv::Mat1w& strength, int y, int x) {
  const int own = y * strength.cols + x;
  int lowest = own;
  int level = strength(y, x);
  const auto look = [&](int neighbour, int at) {
    if (at < level || (at == level && neighbour < lowest)) lowest = neighbour, level = at;
  };
  if (y > 0) look(own - strength.cols, strength(y - 1, x));
  if (x > 0) look(own - 1, strength(y, x - 1));
  if (x + 1 < strength.cols) look(own + 1, strength(y, x + 1));
  if (y + 1 < strength.rows) look(own + strength.cols, strength(y + 1, x));
  return lowest;
}

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// A basin for each pixel from which no water runs on; `lowest` takes their levels.
Basins catchments(const cv::Mat1w& strength, std::vector<int>& lowest) {
  const int pixels = static_cast<int>(strength.total());
  std::vector<int> parent(pixels);
  cv::parallel_for_({0, strength.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < strength.cols; ++x) parent[y * strength.cols + x] = downhill(strength, y, x);
  });
  Basins basins{cv::Mat1i(strength.size(), -1), 0};
  int* const label = basins.labels.ptr<int>();
  const std::uint16_t* const level = strength.ptr<std::uint16_t>();
  for (int p = 0; p < pixels; ++p) {
    const int end = root(parent, p);
    if (label[end] < 0) {
      label[end] = basins.count++;
      lowest.push_back(level[end]);
    }
    label[p] = label[end];
  }
  return basins;
}

// Two basins that meet, and the height of the ridge between them there.
struct Pass {
  int a, b, level;
};

template <class Visit>
void each_pass(const Basins& basins, const cv::Mat1w& strength, Visit&& visit) {
  const cv::Mat1i& labels = basins.labels;
  const auto meet = [&](int y, int x, int v, int u) {
    if (labels(y, x) != labels(v, u))
      visit(Pass{labels(y, x), labels(v, u), std::max<int>(strength(y, x), strength(v, u))});
  };
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      if (x + 1 < labels.cols) meet(y, x, y, x + 1);
      if (y + 1 < labels.rows) meet(y, x, y + 1, x);
    }
}

// Lowest first.
std::vector<Pass> passes(const Basins& basins, const cv::Mat1w& strength) {
  std::vector<std::size_t> start(65537, 0);
  each_pass(basins, strength, [&](const Pass& pass) { ++start[pass.level + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Pass> sorted(start.back());
  each_pass(basins, strength, [&](const Pass& pass) { sorted[start[pass.level]++] = pass; });
  return sorted;
}

}  // namespace

Basins watershed(const cv::Mat1w& strength, int depth) {
  std::vector<int> lowest;
  Basins basins = catchments(strength, lowest);
  std::vector<int> joined(basins.count);  // what each basin has flowed into
  std::iota(joined.begin(), joined.end(), 0);
  for (const Pass& pass : passes(basins, strength)) {
    const int a = root(joined, pass.a), b = root(joined, pass.b);
    if (a == b) continue;
    const int deep = lowest[a] <= lowest[b] ? a : b, shallow = deep == a ? b : a;
    if (pass.level - lowest[shallow] < depth) joined[shallow] = deep;
  }
  std::vector<int> number(basins.count, -1);
  int count = 0;
  for (int& label : basins.labels) {
    int& n = number[root(joined, label)];
    if (n < 0) n = count++;
    label = n;
  }
  basins.count = count;
  return basins;
}

}  // namespace tessera::pebbles

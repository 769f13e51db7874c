#include "tessera/voronoi/cells.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace tessera {
namespace {

struct Run {
  int label;
  int begin, end;  // columns
  int y;
  unsigned char zone;
};

// Maximal runs of one label and zone; `row_first[y]` is where row y begins.
std::vector<Run> find_runs(const LabelMap& labels, const cv::Mat1b& zones, std::vector<int>& row_first) {
  std::vector<Run> runs;
  for (int y = 0; y < labels.rows; ++y) {
    row_first.push_back(static_cast<int>(runs.size()));
    const int* row = labels[y];
    const unsigned char* zone = zones[y];
    for (int x = 0; x < labels.cols;) {
      const int begin = x;
      // A label stays in its zone, so only unlabelled runs need their zone compared.
      do ++x;
      while (x < labels.cols && row[x] == row[begin] && (row[x] >= 0 || zone[x] == zone[begin]));
      runs.push_back({row[begin], begin, x, y, zone[begin]});
    }
  }
  row_first.push_back(static_cast<int>(runs.size()));
  return runs;
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Calls join(upper, lower) for each pair of runs in neighbouring rows that share columns.
template <class Join>
void for_touching_rows(const std::vector<Run>& runs, const std::vector<int>& row_first, const Join& join) {
  for (std::size_t y = 1; y + 1 < row_first.size(); ++y) {
    int upper = row_first[y - 1];
    for (int lower = row_first[y]; lower < row_first[y + 1]; ++lower) {
      while (upper < row_first[y] && runs[upper].end <= runs[lower].begin) ++upper;
      for (int k = upper; k < row_first[y] && runs[k].begin < runs[lower].end; ++k) join(k, lower);
    }
  }
}

// The parts that may not stay as they are: for each its runs.
std::vector<std::vector<int>> find_fragments(const std::vector<Run>& runs, const std::vector<int>& row_first, int cells) {
  std::vector<int> parent(runs.size());
  std::iota(parent.begin(), parent.end(), 0);
  for_touching_rows(runs, row_first, [&](int upper, int lower) {
    if (runs[upper].label != runs[lower].label || runs[upper].zone != runs[lower].zone) return;
    const int a = root_of(parent, upper), b = root_of(parent, lower);
    parent[std::max(a, b)] = std::min(a, b);
  });
  std::vector<int> pixels(runs.size(), 0), largest(cells, -1);
  for (std::size_t i = 0; i < runs.size(); ++i) pixels[root_of(parent, static_cast<int>(i))] += runs[i].end - runs[i].begin;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (parent[i] != static_cast<int>(i) || runs[i].label < 0) continue;
    int& best = largest[runs[i].label];
    if (best < 0 || pixels[i] > pixels[best]) best = static_cast<int>(i);
  }
  std::map<int, std::vector<int>> fragments;  // by root, hence in reading order
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const int root = root_of(parent, static_cast<int>(i));
    if (runs[i].label < 0 || largest[runs[i].label] != root) fragments[root].push_back(static_cast<int>(i));
  }
  std::vector<std::vector<int>> list;
  for (auto& [root, members] : fragments) list.push_back(std::move(members));
  return list;
}

// The neighbour label with the longest border to the runs, among settled pixels of the same zone; -1: none.
int best_neighbour(const LabelMap& labels, const cv::Mat1b& zones, const std::vector<Run>& runs,
                   const std::vector<int>& members) {
  std::map<int, int> border;
  const auto look = [&](int x, int y, unsigned char zone) {
    if (x < 0 || y < 0 || x >= labels.cols || y >= labels.rows) return;
    if (zones(y, x) == zone && labels(y, x) >= 0) ++border[labels(y, x)];
  };
  for (const int i : members) {
    const Run& run = runs[i];
    look(run.begin - 1, run.y, run.zone);
    look(run.end, run.y, run.zone);
    for (int x = run.begin; x < run.end; ++x) {
      look(x, run.y - 1, run.zone);
      look(x, run.y + 1, run.zone);
    }
  }
  int best = -1;
  for (const auto& [label, length] : border)
    if (best < 0 || length > border[best]) best = label;
  return best;
}

void paint(LabelMap& labels, const std::vector<Run>& runs, const std::vector<int>& members, int label) {
  for (const int i : members) std::fill(labels[runs[i].y] + runs[i].begin, labels[runs[i].y] + runs[i].end, label);
}

}  // namespace

int connect_cells(LabelMap& labels, const cv::Mat1b& zones, int cells) {
  std::vector<int> row_first;
  const std::vector<Run> runs = find_runs(labels, zones, row_first);
  std::vector<std::vector<int>> fragments = find_fragments(runs, row_first, cells);
  for (const auto& members : fragments) paint(labels, runs, members, kUnlabelled);
  // Fragments may border only on other fragments: settle from the outside in, in rounds.
  while (!fragments.empty()) {
    std::vector<std::vector<int>> waiting;
    for (auto& members : fragments) {
      const int label = best_neighbour(labels, zones, runs, members);
      if (label >= 0) {
        paint(labels, runs, members, label);
      } else {
        waiting.push_back(std::move(members));
      }
    }
    if (waiting.size() == fragments.size()) {
      paint(labels, runs, waiting.front(), cells++);
      waiting.erase(waiting.begin());
    }
    fragments = std::move(waiting);
  }
  return cells;
}

}  // namespace tessera

#include "tessera/voronoi/cells.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <opencv2/core/utility.hpp>
#include <vector>

namespace tessera {
namespace {

// Whether pixel x of a row continues the run of the pixel before. A label stays in its zone, so only unlabelled runs
// need their zone compared.
bool continues(const int* row, const unsigned char* zone, int x) {
  return (row[x] == row[x - 1]) & ((row[x] >= 0) | (zone[x] == zone[x - 1]));
}

// Maximal runs of one label and zone. They are counted first: there are many, and memory is dear when it is new.
CellRuns find_runs(const LabelMap& labels, const cv::Mat1b& zones) {
  CellRuns runs;
  runs.row_first.assign(labels.rows + 1, 0);
  cv::parallel_for_({0, labels.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      int count = 1;
      for (int x = 1; x < labels.cols; ++x) count += !continues(labels[y], zones[y], x);
      runs.row_first[y + 1] = count;
    }
  });
  for (int y = 0; y < labels.rows; ++y) runs.row_first[y + 1] += runs.row_first[y];
  runs.all.resize(runs.row_first.back());
  cv::parallel_for_({0, labels.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      CellRun* run = &runs.all[runs.row_first[y]];
      *run = {labels(y, 0), 0, labels.cols, y};
      for (int x = 1; x < labels.cols; ++x) {
        if (continues(labels[y], zones[y], x)) continue;
        run->end = x;
        *++run = {labels(y, x), x, labels.cols, y};
      }
    }
  });
  return runs;
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Calls join(upper, lower) for each pair of runs in neighbouring rows that share columns.
template <class Join>
void for_touching_rows(const CellRuns& runs, const Join& join) {
  for (std::size_t y = 1; y + 1 < runs.row_first.size(); ++y) {
    int upper = runs.row_first[y - 1];
    for (int lower = runs.row_first[y]; lower < runs.row_first[y + 1]; ++lower) {
      while (runs.all[upper].end <= runs.all[lower].begin) ++upper;
      for (int k = upper; k < runs.row_first[y] && runs.all[k].begin < runs.all[lower].end; ++k) join(k, lower);
    }
  }
}

// For each run the first run, in reading order, of the connected part it belongs to.
std::vector<int> find_parts(const CellRuns& runs, const cv::Mat1b& zones) {
  const auto zone = [&](const CellRun& run) { return zones(run.y, run.begin); };
  std::vector<int> part(runs.all.size());
  std::iota(part.begin(), part.end(), 0);
  for_touching_rows(runs, [&](int upper, int lower) {
    const CellRun &a = runs.all[upper], &b = runs.all[lower];
    if (a.label != b.label || (a.label < 0 && zone(a) != zone(b))) return;
    const int i = root_of(part, upper), k = root_of(part, lower);
    part[std::max(i, k)] = std::min(i, k);
  });
  for (int& i : part) i = part[i];  // roots come first, so one step is enough
  return part;
}

// The parts that may not stay as they are: for each its runs.
std::vector<std::vector<int>> find_fragments(const CellRuns& runs, const cv::Mat1b& zones, int cells) {
  const std::vector<int> part = find_parts(runs, zones);
  std::vector<int> pixels(part.size(), 0), largest(cells, -1);
  for (std::size_t i = 0; i < part.size(); ++i) pixels[part[i]] += runs.all[i].end - runs.all[i].begin;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i] != static_cast<int>(i) || runs.all[i].label < 0) continue;
    int& best = largest[runs.all[i].label];
    if (best < 0 || pixels[i] > pixels[best]) best = static_cast<int>(i);
  }
  std::map<int, std::vector<int>> fragments;  // by first run, hence in reading order
  for (std::size_t i = 0; i < part.size(); ++i)
    if (runs.all[i].label < 0 || largest[runs.all[i].label] != part[i])
      fragments[part[i]].push_back(static_cast<int>(i));
  std::vector<std::vector<int>> list;
  for (auto& [first, members] : fragments) list.push_back(std::move(members));
  return list;
}

// The neighbour label with the longest border to the runs, among settled ones of the same zone; -1: none.
int best_neighbour(const CellRuns& runs, const cv::Mat1b& zones, const std::vector<int>& members) {
  std::map<int, int> border;
  const auto zone = [&](const CellRun& run) { return zones(run.y, run.begin); };
  for (const int i : members) {
    const CellRun& run = runs.all[i];
    const auto look = [&](const CellRun& other, int sides) {
      if (other.label >= 0 && zone(other) == zone(run)) border[other.label] += sides;
    };
    if (i > runs.row_first[run.y]) look(runs.all[i - 1], 1);
    if (i + 1 < runs.row_first[run.y + 1]) look(runs.all[i + 1], 1);
    for (const int y : {run.y - 1, run.y + 1}) {
      if (y < 0 || y + 1 >= static_cast<int>(runs.row_first.size())) continue;
      const auto end = runs.all.begin() + runs.row_first[y + 1];
      auto other = std::upper_bound(runs.all.begin() + runs.row_first[y], end, run.begin,
                                    [](int column, const CellRun& r) { return column < r.end; });
      for (; other != end && other->begin < run.end; ++other)
        look(*other, std::min(run.end, other->end) - std::max(run.begin, other->begin));
    }
  }
  int best = -1;
  for (const auto& [label, length] : border)
    if (best < 0 || length > border[best]) best = label;
  return best;
}

void relabel(CellRuns& runs, const std::vector<int>& members, int label) {
  for (const int i : members) runs.all[i].label = label;
}

}  // namespace

CellRuns connected_runs(const LabelMap& labels, const cv::Mat1b& zones, int& cells) {
  CellRuns runs = find_runs(labels, zones);
  std::vector<std::vector<int>> fragments = find_fragments(runs, zones, cells);
  for (const auto& members : fragments) {
    relabel(runs, members, kUnlabelled);
    runs.changed.insert(runs.changed.end(), members.begin(), members.end());
  }
  // Fragments may border only on other fragments: settle from the outside in, in rounds.
  while (!fragments.empty()) {
    std::vector<std::vector<int>> waiting;
    for (auto& members : fragments) {
      const int label = best_neighbour(runs, zones, members);
      if (label >= 0) {
        relabel(runs, members, label);
      } else {
        waiting.push_back(std::move(members));
      }
    }
    if (waiting.size() == fragments.size()) {
      relabel(runs, waiting.front(), cells++);
      waiting.erase(waiting.begin());
    }
    fragments = std::move(waiting);
  }
  return runs;
}

int connect_cells(LabelMap& labels, const cv::Mat1b& zones, int cells) {
  const CellRuns runs = connected_runs(labels, zones, cells);
  for (const int i : runs.changed) {
    const CellRun& run = runs.all[i];
    std::fill(labels[run.y] + run.begin, labels[run.y] + run.end, run.label);
  }
  return cells;
}

}  // namespace tessera

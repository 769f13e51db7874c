#include "tessera/voronoi/cells.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <opencv2/core/utility.hpp>
#include <vector>

namespace tessera {
namespace {

struct Run {
  int label;
  int begin, end;  // columns
  int y;
};

struct Runs {
  std::vector<Run> all;
  std::vector<int> row_first;  // where each row begins; one more at the end
};

// Whether pixel x of a row continues the run of the pixel before. A label stays in its zone, so only unlabelled runs
// need their zone compared.
bool continues(const int* row, const unsigned char* zone, int x) {
  return (row[x] == row[x - 1]) & ((row[x] >= 0) | (zone[x] == zone[x - 1]));
}

// Maximal runs of one label and zone. They are counted first: there are many, and memory is dear when it is new.
Runs find_runs(const LabelMap& labels, const cv::Mat1b& zones) {
  Runs runs;
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
      Run* run = &runs.all[runs.row_first[y]];
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
void for_touching_rows(const Runs& runs, const Join& join) {
  for (std::size_t y = 1; y + 1 < runs.row_first.size(); ++y) {
    int upper = runs.row_first[y - 1];
    for (int lower = runs.row_first[y]; lower < runs.row_first[y + 1]; ++lower) {
      while (runs.all[upper].end <= runs.all[lower].begin) ++upper;
      for (int k = upper; k < runs.row_first[y] && runs.all[k].begin < runs.all[lower].end; ++k) join(k, lower);
    }
  }
}

// For each run the first run, in reading order, of the connected part it belongs to.
std::vector<int> find_parts(const Runs& runs, const cv::Mat1b& zones) {
  const auto zone = [&](const Run& run) { return zones(run.y, run.begin); };
  std::vector<int> part(runs.all.size());
  std::iota(part.begin(), part.end(), 0);
  for_touching_rows(runs, [&](int upper, int lower) {
    const Run &a = runs.all[upper], &b = runs.all[lower];
    if (a.label != b.label || (a.label < 0 && zone(a) != zone(b))) return;
    const int i = root_of(part, upper), k = root_of(part, lower);
    part[std::max(i, k)] = std::min(i, k);
  });
  for (int& i : part) i = part[i];  // roots come first, so one step is enough
  return part;
}

// The parts that may not stay as they are: for each its runs.
std::vector<std::vector<int>> find_fragments(const Runs& runs, const cv::Mat1b& zones, int cells) {
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

// The neighbour label with the longest border to the runs, among settled pixels of the same zone; -1: none.
int best_neighbour(const LabelMap& labels, const cv::Mat1b& zones, const Runs& runs,
                   const std::vector<int>& members) {
  std::map<int, int> border;
  const auto look = [&](int x, int y, unsigned char zone) {
    if (x < 0 || y < 0 || x >= labels.cols || y >= labels.rows) return;
    if (zones(y, x) == zone && labels(y, x) >= 0) ++border[labels(y, x)];
  };
  for (const int i : members) {
    const Run& run = runs.all[i];
    const unsigned char zone = zones(run.y, run.begin);
    look(run.begin - 1, run.y, zone);
    look(run.end, run.y, zone);
    for (int x = run.begin; x < run.end; ++x) {
      look(x, run.y - 1, zone);
      look(x, run.y + 1, zone);
    }
  }
  int best = -1;
  for (const auto& [label, length] : border)
    if (best < 0 || length > border[best]) best = label;
  return best;
}

void paint(LabelMap& labels, const Runs& runs, const std::vector<int>& members, int label) {
  for (const int i : members) std::fill(labels[runs.all[i].y] + runs.all[i].begin, labels[runs.all[i].y] + runs.all[i].end, label);
}

}  // namespace

int connect_cells(LabelMap& labels, const cv::Mat1b& zones, int cells) {
  const Runs runs = find_runs(labels, zones);
  std::vector<std::vector<int>> fragments = find_fragments(runs, zones, cells);
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

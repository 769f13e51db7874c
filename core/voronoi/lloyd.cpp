// Sums over cells. Compiled once for each vector instruction set (Highway's foreach_target).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tessera/voronoi/lloyd.cpp"
// clang-format off
#include <hwy/foreach_target.h>
// clang-format on

#include "tessera/voronoi/lloyd.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "tessera/base/portable_math.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Labels = hn::CappedTag<std::int32_t, 8>;
constexpr int kStep = 64;  // pixels whose ends of runs are found at a time

// Bit i is set where the labels of pixels i and i + 1 differ, for kStep pixels.
std::uint64_t ends_of_runs(const std::int32_t* row) {
  const Labels d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Labels()));
  std::uint64_t ends = 0;
  for (int i = 0; i < kStep; i += kLanes) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Ne(hn::LoadU(d, row + i), hn::LoadU(d, row + i + 1)), bits);
    ends |= static_cast<std::uint64_t>(bits[0]) << i;
  }
  return ends;
}

// Adds runs of equal labels, not pixels: a run of row y has its sums in closed form.
void add_row(const std::int32_t* row, int columns, int y, CellMoments* moments) {
  int begin = 0;
  const auto end_run = [&](int end) {
    if (row[begin] >= 0) {
      CellMoments& m = moments[row[begin]];
      const std::int64_t n = end - begin;
      m.count += n;
      m.sum_x += n * (begin + end - 1) / 2;
      m.sum_y += n * y;
    }
    begin = end;
  };
  int x = 0;
  for (; x + kStep < columns; x += kStep)
    for (std::uint64_t rest = ends_of_runs(row + x); rest != 0; rest &= rest - 1)
      end_run(x + __builtin_ctzll(rest) + 1);
  for (; x + 1 < columns; ++x)
    if (row[x] != row[x + 1]) end_run(x + 1);
  end_run(columns);
}

void add_rows(const LabelMap& labels, int begin, int end, CellMoments* moments) {
  for (int y = begin; y < end; ++y) add_row(labels[y], labels.cols, y, moments);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {
HWY_EXPORT(add_rows);

const std::vector<CellMoments>& CellSums::of(const LabelMap& labels, int cells) {
  const int stripes = std::clamp(cv::getNumThreads(), 1, 8);
  partial_.resize(stripes);
  cv::parallel_for_({0, stripes}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      partial_[i].assign(cells, {});
      HWY_DYNAMIC_DISPATCH(add_rows)
      (labels, labels.rows * i / stripes, labels.rows * (i + 1) / stripes, partial_[i].data());
    }
  });
  cv::parallel_for_({0, cells}, [&](const cv::Range& range) {
    for (int i = 1; i < stripes; ++i) {
      for (int k = range.start; k < range.end; ++k) {
        partial_[0][k].count += partial_[i][k].count;
        partial_[0][k].sum_x += partial_[i][k].sum_x;
        partial_[0][k].sum_y += partial_[i][k].sum_y;
      }
    }
  });
  return partial_[0];
}

namespace {

void move_beside(Site& site, const Site& large, const CellMoments& cell) {
  const SinCos turn = sin_cos(large.angle);
  const double away = 0.3 * std::sqrt(static_cast<double>(cell.count));
  site.x = snap_position(cell.centroid_x() + away * turn.cos);
  site.y = snap_position(cell.centroid_y() + away * turn.sin);
  site.angle = large.angle;
}

}  // namespace

int reseed_empty(Sites& sites, const std::vector<CellMoments>& moments) {
  std::map<int, std::vector<int>> largest;  // by zone, filled where needed: a heap
  const auto smaller = [&](int a, int b) {
    return moments[a].count != moments[b].count ? moments[a].count < moments[b].count : a < b;
  };
  int reseeded = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (moments[i].count > 0) continue;
    std::vector<int>& candidates = largest[sites[i].zone];
    if (candidates.empty()) {
      for (std::size_t k = 0; k < sites.size(); ++k)
        if (sites[k].zone == sites[i].zone && moments[k].count > 1) candidates.push_back(static_cast<int>(k));
      std::make_heap(candidates.begin(), candidates.end(), smaller);
    }
    if (candidates.empty()) continue;
    std::pop_heap(candidates.begin(), candidates.end(), smaller);
    const int k = candidates.back();
    candidates.pop_back();
    move_beside(sites[i], sites[k], moments[k]);
    ++reseeded;
  }
  return reseeded;
}

int reseed_empty_near(Sites& sites, const std::vector<CellMoments>& moments, double reach) {
  using Bin = std::pair<int, int>;
  const auto bin_of = [&](const Site& site) {
    return Bin(static_cast<int>(std::floor(site.y / reach)), static_cast<int>(std::floor(site.x / reach)));
  };
  std::vector<std::size_t> empty;
  std::map<Bin, std::vector<std::size_t>> bins;  // those around empty cells
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (moments[i].count > 0) continue;
    empty.push_back(i);
    const auto [row, column] = bin_of(sites[i]);
    for (int y = row - 1; y <= row + 1; ++y)
      for (int x = column - 1; x <= column + 1; ++x) bins[{y, x}];
  }
  if (empty.empty()) return 0;
  for (std::size_t i = 0; i < sites.size(); ++i)
    if (const auto bin = bins.find(bin_of(sites[i])); bin != bins.end() && moments[i].count > 1)
      bin->second.push_back(i);
  std::vector<char> taken(sites.size(), 0);
  int reseeded = 0;
  for (const std::size_t i : empty) {
    Site& site = sites[i];
    const auto [row, column] = bin_of(site);
    std::size_t best = sites.size();
    std::int64_t most = 0;
    for (int y = row - 1; y <= row + 1; ++y) {
      for (int x = column - 1; x <= column + 1; ++x) {
        for (const std::size_t k : bins[{y, x}]) {
          const double dx = sites[k].x - site.x, dy = sites[k].y - site.y;
          if (taken[k] || sites[k].zone != site.zone || dx * dx + dy * dy > reach * reach) continue;
          if (moments[k].count < most || (moments[k].count == most && k > best)) continue;
          best = k;
          most = moments[k].count;
        }
      }
    }
    if (best == sites.size()) continue;
    taken[best] = 1;
    move_beside(site, sites[best], moments[best]);
    ++reseeded;
  }
  return reseeded;
}

std::vector<CellMoments> cell_moments(const LabelMap& labels, int cells) { return CellSums().of(labels, cells); }

}  // namespace tessera
#endif

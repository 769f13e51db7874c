#include "tessera/parquetry/seams.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace tessera::parquetry {
namespace {

constexpr int kRepetitions = 2;
constexpr std::int64_t kNotFree = std::int64_t{1} << 40;  // of a pixel; more than all errors beside a cut
constexpr double kOpening = 0.36;  // tangent of 20 degrees: what is left between two seams are 50

// Seams of one direction, seen as if they ran down the columns: `along` them a pixel has its row, across them its
// place.
class Direction {
 public:
  Direction(const Reconstruction& reconstruction, const SeamLimits& limits, bool down)
      : reconstruction_(reconstruction),
        limits_(limits),
        down_(down),
        lines_(down ? reconstruction.grid.columns : reconstruction.grid.rows),
        across_(down ? reconstruction.grid.rows : reconstruction.grid.columns) {}

  // The best seam along inner line `line`, given those that cross it.
  Seam best(int line, const std::vector<Seam>& crossing) const {
    CutCosts costs = costs_along(line, crossing);
    bar(line, crossing, costs);
    Seam seam = cheapest_cut(costs);
    for (int& place : seam) place += first(line);
    return seam;
  }

 private:
  int length() const { return across_.back(); }
  int first(int line) const { return lines_[line] - limits_.stray; }
  const Reconstruction::Piece& piece(int line, int crossing) const {
    return down_ ? reconstruction_.piece(line, crossing) : reconstruction_.piece(crossing, line);
  }
  std::int64_t error(const Reconstruction::Piece& piece, int along, int place) const {
    const int x = down_ ? place : along, y = down_ ? along : place;
    return piece.may_have(x, y) ? reconstruction_.error(piece, x, y) : kNotFree;
  }

  // Eq. 9 in every row, over all that the line's neighbours overlap.
  CutCosts costs_along(int line, const std::vector<Seam>& crossing) const {
    const int overlap = 2 * limits_.stray;
    CutCosts costs{overlap + 1, std::vector<std::int64_t>(static_cast<std::size_t>(length()) * (overlap + 1)), {}};
    std::vector<int> at(overlap, 0);  // between which of the crossing seams a pixel is
    std::vector<std::int64_t> left(overlap), right(overlap);
    for (int along = 0; along < length(); ++along) {
      for (int k = 0; k < overlap; ++k) {
        const int place = first(line) + k;
        while (along >= crossing[at[k] + 1][place]) ++at[k];
        left[k] = error(piece(line - 1, at[k]), along, place);
        right[k] = error(piece(line, at[k]), along, place);
      }
      cut_costs(left.data(), right.data(), overlap, &costs.costs[static_cast<std::size_t>(along) * costs.width]);
    }
    limit(line, costs);
    return costs;
  }

  // How far the seam may be from its line in each row.
  std::vector<int> allowed(int line) const {
    std::vector<int> allowed(length(), limits_.stray);
    for (std::size_t k = 0; k + 1 < across_.size(); ++k) {
      // At a crossing, so that no piece has a horn there.
      const int reach = static_cast<int>(std::ceil(limits_.at_crossing + limits_.stray / kOpening));
      const int last = std::min(length(), across_[k] + reach);
      for (int along = std::max(0, across_[k] - reach); k > 0 && along < last; ++along) {
        const double from = std::abs(along + 0.5 - across_[k]) - limits_.at_crossing;
        const auto most = static_cast<int>(limits_.at_crossing + kOpening * std::max(0.0, from));
        allowed[along] = std::min(allowed[along], most);
      }
      // Beside pieces without wood, and as far as the seams that cross there may be.
      if (!piece(line - 1, static_cast<int>(k)).features.empty() &&
          !piece(line, static_cast<int>(k)).features.empty())
        continue;
      const int end = std::min(length(), across_[k + 1] + limits_.stray);
      for (int along = std::max(0, across_[k] - limits_.stray); along < end; ++along) allowed[along] = 0;
    }
    return allowed;
  }

  void limit(int line, CutCosts& costs) const {
    const std::vector<int> allowed = this->allowed(line);
    for (int along = 0; along < length(); ++along)
      for (int place = 0; place < costs.width; ++place) {
        std::int64_t& cost = costs.costs[static_cast<std::size_t>(along) * costs.width + place];
        if (cost >= kNotFree || std::abs(place - limits_.stray) > allowed[along]) cost = CutCosts::kNever;
      }
  }

  // Steps that are parallel to one of a crossing seam, middle to middle nearer than `apart`.
  void bar(int line, const std::vector<Seam>& crossing, CutCosts& costs) const {
    costs.barred.assign(costs.costs.size(), 0);
    const int reach = static_cast<int>(std::ceil(limits_.apart));
    const int begin = std::max(0, first(line) - reach - 1);
    for (std::size_t k = 1; k + 1 < crossing.size(); ++k) {
      const Seam& other = crossing[k];
      const int end = std::min(static_cast<int>(other.size()) - 1, lines_[line] + limits_.stray + reach + 1);
      for (int place = begin; place < end; ++place)
        if (const int step = other[place + 1] - other[place]; step != 0)
          bar_around(place + 1, other[place] + 0.5 * step, step, line, costs);
    }
  }

  void bar_around(double place, double along, int step, int line, CutCosts& costs) const {
    // A step from `place` in row `along` has its middle at (place + step / 2, along + 1).
    const int top = std::max(0, static_cast<int>(std::ceil(along - 1 - limits_.apart)));
    const int bottom = std::min(length() - 1, static_cast<int>(std::floor(along - 1 + limits_.apart)));
    const double from = place - 0.5 * step - first(line);
    const int left = std::max(0, static_cast<int>(std::ceil(from - limits_.apart)));
    const int right = std::min(costs.width - 1, static_cast<int>(std::floor(from + limits_.apart)));
    for (int row = top; row <= bottom; ++row)
      for (int k = left; k <= right; ++k)
        costs.barred[static_cast<std::size_t>(row) * costs.width + k] |=
            step < 0 ? CutCosts::kLeft : CutCosts::kRight;
  }

  const Reconstruction& reconstruction_;
  SeamLimits limits_;
  bool down_;
  const std::vector<int>& lines_;
  const std::vector<int>& across_;
};

}  // namespace

Seams straight_seams(const Grid& grid) {
  Seams seams;
  for (const int x : grid.columns) seams.columns.emplace_back(grid.rows.back(), x);
  for (const int y : grid.rows) seams.rows.emplace_back(grid.columns.back(), y);
  return seams;
}

std::int64_t Reconstruction::error(const Piece& piece, int x, int y) const {
  if (piece.features.empty()) return 0;
  const int channels = target.channels();
  const std::uint8_t* wanted = target.ptr(y, x);
  const std::uint8_t* have = piece.features.ptr(y - piece.box.y, x - piece.box.x);
  int sum = 0;
  for (int k = 0; k < channels; ++k) sum += (wanted[k] - have[k]) * (wanted[k] - have[k]);
  return sum;
}

std::int64_t cost_of(const Reconstruction& reconstruction, const Seams& seams) {
  const Grid& grid = reconstruction.grid;
  std::int64_t sum = 0;
  std::vector<int> row(grid.columns.back(), 0);
  for (int y = 0; y < grid.rows.back(); ++y)
    for (int x = 0, column = 0; x < grid.columns.back(); ++x) {
      while (x >= seams.columns[column + 1][y]) ++column;
      while (y >= seams.rows[row[x] + 1][x]) ++row[x];
      sum += reconstruction.error(reconstruction.piece(column, row[x]), x, y);
    }
  return sum;
}

void cut_costs(const std::int64_t* left, const std::int64_t* right, int overlap, std::int64_t* costs) {
  costs[0] = 0;
  for (int x = 0; x < overlap; ++x) costs[0] += right[x];
  for (int x = 0; x < overlap; ++x) costs[x + 1] = costs[x] + left[x] - right[x];
}

std::vector<int> cheapest_cut(const CutCosts& given) {
  const int width = given.width, rows = static_cast<int>(given.costs.size()) / width;
  std::vector<std::int64_t> sums(given.costs.begin(), given.costs.begin() + width), next(width);
  std::vector<std::int8_t> steps(given.costs.size(), 0);  // by which a place was reached
  const auto barred = [&](int row, int place, CutCosts::Step step) {
    return !given.barred.empty() && (given.barred[static_cast<std::size_t>(row) * width + place] & step) != 0;
  };
  for (int row = 1; row < rows; ++row) {
    for (int place = 0; place < width; ++place) {
      std::int64_t least = sums[place];
      std::int8_t step = 0;
      if (place > 0 && sums[place - 1] < least && !barred(row - 1, place - 1, CutCosts::kRight))
        least = sums[place - 1], step = 1;
      if (place + 1 < width && sums[place + 1] < least && !barred(row - 1, place + 1, CutCosts::kLeft))
        least = sums[place + 1], step = -1;
      const std::size_t here = static_cast<std::size_t>(row) * width + place;
      next[place] = std::min(CutCosts::kNever, least + given.costs[here]);
      steps[here] = step;
    }
    sums.swap(next);
  }
  int place = width / 2;
  for (int k = 0; k < width; ++k)
    if (sums[k] < sums[place] ||
        (sums[k] == sums[place] && std::abs(2 * k - width + 1) < std::abs(2 * place - width + 1)))
      place = k;
  assert(sums[place] < CutCosts::kNever);
  std::vector<int> cut(rows);
  for (int row = rows - 1; row >= 0; --row) {
    cut[row] = place;
    place -= steps[static_cast<std::size_t>(row) * width + place];
  }
  return cut;
}

Seams find_seams(const Reconstruction& reconstruction, const SeamLimits& limits) {
  Seams seams = straight_seams(reconstruction.grid);
  if (limits.stray <= 0) return seams;
  const Direction down(reconstruction, limits, true), across(reconstruction, limits, false);
  const auto improve = [](const Direction& direction, std::vector<Seam>& lines, const std::vector<Seam>& crossing) {
    cv::parallel_for_({1, std::max(1, static_cast<int>(lines.size()) - 1)}, [&](const cv::Range& range) {
      for (int line = range.start; line < range.end; ++line) lines[line] = direction.best(line, crossing);
    });
  };
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    improve(down, seams.columns, seams.rows);
    improve(across, seams.rows, seams.columns);
  }
  return seams;
}

}  // namespace tessera::parquetry

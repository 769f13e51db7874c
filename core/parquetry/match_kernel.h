// The inner loops of matching, on plain arrays; vector instructions are picked at run time. Whole numbers only: the
// same on every platform.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tessera::parquetry {

// What is compared with a place of a picture of bytes: rows of them, and 255 in `mask` for each that counts.
struct Stencil {
  Stencil() = default;
  Stencil(std::vector<int> rows, int bytes);  // zeros

  int rows() const { return static_cast<int>(order.size()); }

  // Byte i of row k counts.
  void set(int k, int i, std::uint8_t value);

  static constexpr int kVector = 64;
  std::ptrdiff_t stride = 0;      // a multiple of kVector; rows are filled up with zeros
  std::vector<int> order;         // which row of the place each is compared with
  std::vector<int> begins, ends;  // of what counts in each row; no bytes: 0, 0
  std::vector<std::uint8_t> values, mask;
};

// The picture's bytes, where each of its rows has the first one, from the first row that is compared, and the column.
struct Spot {
  const std::uint8_t* data;
  const std::ptrdiff_t* starts;
  std::ptrdiff_t x;
};

inline constexpr int kLook = 4;  // rows
inline int looks(int rows) { return (rows + kLook - 1) / kLook; }

// Sums of squared differences: after every kLook rows, and after all, the sum so far goes to `sums`; given up, with
// false, where it is above that of `limits`. May read up to a vector beyond the rows' ends.
bool compare(const Stencil& stencil, const Spot& spot, const std::int64_t* limits, std::int64_t* sums);

// Four at once, in pictures whose bytes are `plane` apart; given up where all are above. `sums` has four after each
// look. Returns for each whether it was never above, as a bit.
unsigned compare_four(const Stencil& stencil, const Spot& spot, std::ptrdiff_t plane, const std::int64_t* limits,
                      std::int64_t* sums);

// A block of a patch at its place from the first group of a row on, in the planes of a coarse level (levels.h).
struct CoarseBlock {
  const std::uint8_t* planes;
  std::ptrdiff_t plane_size;
  int shift;  // squares lose so many bits: larger blocks count for more, and sums stay in range
};

// A row of groups of places.
struct CoarseRow {
  const std::vector<CoarseBlock>* blocks;
  int statistics;               // two to a channel; each has two planes
  const std::uint8_t* targets;  // for each block and statistic the least and greatest value
  const std::uint8_t* room;
  std::uint8_t need;  // groups with less room are kNoRoom
  int groups;
  std::uint16_t limit;  // bounds above it need only be above: the rest of their blocks may be left out
  // Where `sums` is given, it gets the bounds of the first blocks alone: of as many as each of `bands` says, a row of
  // bounds each, `stride` apart.
  const std::vector<int>* bands = nullptr;
  std::uint16_t* sums = nullptr;
  std::ptrdiff_t stride = 0;
};
inline constexpr std::uint16_t kNoRoom = 0xffff;
inline constexpr int kRowPadding = 64;  // elements that are written beyond a row's groups

// The bound of each group, the sum of squared bytes, at most kNoRoom - 1. Returns the least.
std::uint16_t coarse_bounds(const CoarseRow& row, std::uint16_t* bounds);

// Appends the indices of bounds that are at most `limit` (< kNoRoom).
void find_at_most(const std::uint16_t* bounds, int count, std::uint16_t limit, std::vector<int>& found);

}  // namespace tessera::parquetry

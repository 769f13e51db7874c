// The inner loops of matching, on plain arrays; vector instructions are picked at run time. Whole numbers only: the
// same on every platform.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tessera::parquetry {

// What is compared with a place of a picture of bytes: rows of them, a byte of `mask` for each, 255 where it counts.
// `order`: which row of the place each is compared with.
struct Stencil {
  Stencil() = default;
  Stencil(std::vector<int> rows, int bytes);  // zeros

  std::uint8_t* row(int k) { return values.data() + k * stride; }
  std::uint8_t* mask_row(int k) { return mask.data() + k * stride; }

  static constexpr int kVector = 32;
  std::ptrdiff_t stride = 0;  // a multiple of kVector; rows are filled up with zeros
  std::vector<int> order;
  std::vector<std::uint8_t> values, mask;
};

// The rows 0 to `count` - 1, far ones after each other, so that a sum of some of them tells of the whole.
std::vector<int> spread_rows(int count);

// Sum of squared differences, or any number above `limit` where it is above. `starts`: where each row of the picture
// has its first byte, from `data`; of the first row that is compared. May read up to a vector beyond the rows' ends.
std::int64_t squared_differences(const Stencil& stencil, const std::uint8_t* data, const std::ptrdiff_t* starts,
                                 std::ptrdiff_t x, std::int64_t limit);

// A row of groups at a coarse level (levels.h).
struct CoarseRow {
  const std::uint8_t* planes;  // from the row's first group on
  std::ptrdiff_t plane_size;
  int statistics;                             // two to a channel; each has two planes
  const std::vector<std::ptrdiff_t>* blocks;  // where in a plane a block is, from the group
  const std::uint8_t* targets;                // for each block and statistic the least and greatest value
  const std::uint8_t* room;
  std::uint8_t need;  // groups with less room are kNoRoom
  int groups;
};
inline constexpr std::uint16_t kNoRoom = 0xffff;
inline constexpr int kRowPadding = 64;  // elements that are written beyond a row's groups

// The bound of each group, in squared bytes a pixel of a block, at most kNoRoom - 1. Returns the least of them.
std::uint16_t coarse_bounds(const CoarseRow& row, std::uint16_t* bounds);

// Appends the indices of bounds that are at most `limit` (< kNoRoom).
void find_at_most(const std::uint16_t* bounds, int count, std::uint16_t limit, std::vector<int>& found);

}  // namespace tessera::parquetry

// Compiled once for each vector instruction set (Highway's foreach_target).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tessera/parquetry/match_kernel.cpp"
// clang-format off
#include <hwy/foreach_target.h>
// clang-format on

#include "tessera/parquetry/match_kernel.h"

#include <hwy/highway.h>

#include <algorithm>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace tessera::parquetry {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // one lane has no bytes to widen

std::int64_t squared_differences(const Stencil& stencil, const std::uint8_t* data, const std::ptrdiff_t* starts,
                                 std::ptrdiff_t x, std::int64_t limit) {
  std::int64_t total = 0;
  for (std::size_t k = 0; k < stencil.order.size() && total <= limit; ++k) {
    const std::uint8_t* from = data + starts[stencil.order[k]] + x;
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(k) * stencil.stride;
    for (std::ptrdiff_t i = 0; i < stencil.stride; ++i) {
      const int off = stencil.mask[row + i] != 0 ? stencil.values[row + i] - from[i] : 0;
      total += off * off;
    }
  }
  return total;
}

std::uint16_t coarse_bounds(const CoarseRow& row, std::uint16_t* bounds) {
  std::uint16_t least = kNoRoom;
  for (int x = 0; x < row.groups; ++x) {
    bounds[x] = kNoRoom;
    if (row.room[x] < row.need) continue;
    int sum = 0;
    const std::uint8_t* target = row.targets;
    for (const std::ptrdiff_t block : *row.blocks) {
      const std::uint8_t* from = row.planes + block + x;
      for (int s = 0; s < row.statistics; ++s, target += 2, from += 2 * row.plane_size) {
        const int off = std::max({0, from[0] - target[1], target[0] - from[row.plane_size]});
        sum = std::min(kNoRoom - 1, sum + off * off);
      }
    }
    bounds[x] = static_cast<std::uint16_t>(sum);
    least = std::min(least, bounds[x]);
  }
  return least;
}

void find_at_most(const std::uint16_t* bounds, int count, std::uint16_t limit, std::vector<int>& found) {
  for (int i = 0; i < count; ++i)
    if (bounds[i] <= limit) found.push_back(i);
}

#else

using D8 = hn::CappedTag<std::uint8_t, Stencil::kVector>;
using D16 = hn::Repartition<std::int16_t, D8>;
using D32 = hn::Repartition<std::int32_t, D8>;

constexpr int kRowsBetweenLooks = 4;
constexpr std::ptrdiff_t kLongRow = 1 << 13;  // bytes: four of them may be too much for a sum of 32 bits

std::int64_t squared_differences(const Stencil& stencil, const std::uint8_t* data, const std::ptrdiff_t* starts,
                                 std::ptrdiff_t x, std::int64_t limit) {
  const D8 d8;
  const D16 d16;
  const D32 d32;
  const auto zero = hn::Zero(d8);
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d8));
  const std::uint8_t* values = stencil.values.data();
  const std::uint8_t* mask = stencil.mask.data();
  const int rows = static_cast<int>(stencil.order.size());
  const int step = stencil.stride < kLongRow ? kRowsBetweenLooks : 1;
  std::int64_t total = 0;
  for (int k = 0; k < rows;) {
    auto low = hn::Zero(d32), high = hn::Zero(d32), rest = hn::Zero(d32);
    for (const int end = std::min(rows, k + step); k < end; ++k) {
      const std::uint8_t* from = data + starts[stencil.order[k]] + x;
      for (std::ptrdiff_t i = 0; i < stencil.stride; i += lanes, values += lanes, mask += lanes) {
        const auto a = hn::LoadU(d8, values), b = hn::LoadU(d8, from + i);
        const auto off = hn::And(hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a)), hn::LoadU(d8, mask));
        const auto lower = hn::BitCast(d16, hn::InterleaveLower(d8, off, zero));
        const auto upper = hn::BitCast(d16, hn::InterleaveUpper(d8, off, zero));
        low = hn::ReorderWidenMulAccumulate(d32, lower, lower, low, rest);
        high = hn::ReorderWidenMulAccumulate(d32, upper, upper, high, rest);
      }
    }
    total += hn::GetLane(hn::SumOfLanes(d32, hn::Add(hn::Add(low, high), rest)));
    if (total > limit) return total;
  }
  return total;
}

std::uint16_t coarse_bounds(const CoarseRow& row, std::uint16_t* bounds) {
  const hn::ScalableTag<std::uint8_t> d8;
  const hn::Repartition<std::uint16_t, decltype(d8)> d16;
  const auto lanes = static_cast<int>(hn::Lanes(d8));
  const auto need = hn::Set(d8, row.need);
  const auto byte = hn::Set(d16, 0xff), most = hn::Set(d16, kNoRoom - 1), none = hn::Set(d16, kNoRoom);
  const auto square_even = [&](auto v) {
    const auto e = hn::And(hn::BitCast(d16, v), byte);
    return hn::Mul(e, e);
  };
  const auto square_odd = [&](auto v) {
    const auto o = hn::ShiftRight<8>(hn::BitCast(d16, v));
    return hn::Mul(o, o);
  };
  auto least = none;
  for (int x = 0; x < row.groups; x += lanes) {
    const auto lacking = hn::SaturatedSub(need, hn::LoadU(d8, row.room + x));
    const auto is_free = hn::Eq(lacking, hn::Zero(d8));
    if (hn::AllFalse(d8, is_free)) {
      hn::StoreU(none, d16, bounds + x);
      hn::StoreU(none, d16, bounds + x + lanes / 2);
      continue;
    }
    auto even = hn::Zero(d16), odd = hn::Zero(d16);
    const std::uint8_t* target = row.targets;
    for (const std::ptrdiff_t block : *row.blocks) {
      const std::uint8_t* from = row.planes + block + x;
      for (int s = 0; s < row.statistics; ++s, target += 2, from += 2 * row.plane_size) {
        const auto low = hn::LoadU(d8, from), high = hn::LoadU(d8, from + row.plane_size);
        const auto off =
            hn::Max(hn::SaturatedSub(low, hn::Set(d8, target[1])), hn::SaturatedSub(hn::Set(d8, target[0]), high));
        even = hn::SaturatedAdd(even, square_even(off));
        odd = hn::SaturatedAdd(odd, square_odd(off));
      }
    }
    const auto taken = hn::VecFromMask(d8, hn::Not(is_free));
    const auto taken_even = hn::VecFromMask(d16, hn::Eq(hn::And(hn::BitCast(d16, taken), byte), byte));
    const auto taken_odd = hn::VecFromMask(d16, hn::Eq(hn::ShiftRight<8>(hn::BitCast(d16, taken)), byte));
    even = hn::Or(hn::Min(even, most), taken_even);
    odd = hn::Or(hn::Min(odd, most), taken_odd);
    hn::StoreInterleaved2(even, odd, d16, bounds + x);
    // Beyond the row's end there may be anything.
    if (x + lanes <= row.groups)
      least = hn::Min(least, hn::Min(even, odd));
    else
      for (int i = x; i < row.groups; ++i) least = hn::Min(least, hn::Set(d16, bounds[i]));
  }
  HWY_ALIGN std::uint16_t all[HWY_MAX_BYTES / 2];
  hn::Store(least, d16, all);
  return *std::min_element(all, all + hn::Lanes(d16));
}

void find_at_most(const std::uint16_t* bounds, int count, std::uint16_t limit, std::vector<int>& found) {
  const hn::ScalableTag<std::uint16_t> d16;
  const auto lanes = static_cast<int>(hn::Lanes(d16));
  const auto at_most = hn::Set(d16, limit);
  for (int x = 0; x < count; x += lanes) {
    const auto over = hn::SaturatedSub(hn::LoadU(d16, bounds + x), at_most);
    if (hn::AllFalse(d16, hn::Eq(over, hn::Zero(d16)))) continue;
    for (int i = x; i < std::min(count, x + lanes); ++i)
      if (bounds[i] <= limit) found.push_back(i);
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace tessera::parquetry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::parquetry {

Stencil::Stencil(std::vector<int> rows, int bytes)
    : stride((bytes + kVector - 1) / kVector * kVector),
      order(std::move(rows)),
      values(static_cast<std::size_t>(stride) * order.size()),
      mask(values.size()) {}

std::vector<int> spread_rows(int count) {
  constexpr int kApart = 4;
  std::vector<int> rows;
  for (int first = 0; first < kApart; ++first)
    for (int y = first; y < count; y += kApart) rows.push_back(y);
  return rows;
}

HWY_EXPORT(squared_differences);
HWY_EXPORT(coarse_bounds);
HWY_EXPORT(find_at_most);

std::int64_t squared_differences(const Stencil& stencil, const std::uint8_t* data, const std::ptrdiff_t* starts,
                                 std::ptrdiff_t x, std::int64_t limit) {
  return HWY_DYNAMIC_DISPATCH(squared_differences)(stencil, data, starts, x, limit);
}
std::uint16_t coarse_bounds(const CoarseRow& row, std::uint16_t* bounds) {
  return HWY_DYNAMIC_DISPATCH(coarse_bounds)(row, bounds);
}
void find_at_most(const std::uint16_t* bounds, int count, std::uint16_t limit, std::vector<int>& found) {
  HWY_DYNAMIC_DISPATCH(find_at_most)(bounds, count, limit, found);
}

}  // namespace tessera::parquetry
#endif

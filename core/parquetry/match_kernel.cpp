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

// Where the sums of a row's first blocks go.
class Bands {
 public:
  Bands(const CoarseRow& row, int x) : row_(row), to_(row.sums ? row.sums + x : nullptr) {}

  // Null, but for the last block of a band.
  std::uint16_t* after(int block) {
    if (!to_ || block + 1 != (*row_.bands)[band_]) return nullptr;
    ++band_;
    to_ += row_.stride;
    return to_ - row_.stride;
  }

 private:
  const CoarseRow& row_;
  std::uint16_t* to_;
  std::size_t band_ = 0;
};

#if HWY_TARGET == HWY_SCALAR  // one lane has no bytes to widen

bool compare(const Stencil& stencil, const Spot& spot, const std::int64_t* limits, std::int64_t* sums) {
  std::int64_t sum = 0;
  for (int k = 0; k < stencil.rows(); ++k) {
    const std::uint8_t* from = spot.data + spot.starts[stencil.order[k]] + spot.x;
    const std::ptrdiff_t row = k * stencil.stride;
    for (int i = stencil.begins[k]; i < stencil.ends[k]; ++i) {
      const int off = stencil.mask[row + i] != 0 ? stencil.values[row + i] - from[i] : 0;
      sum += off * off;
    }
    if ((k + 1) % kLook != 0 && k + 1 < stencil.rows()) continue;
    *sums++ = sum;
    if (sum > *limits++) return false;
  }
  return true;
}

unsigned compare_four(const Stencil& stencil, const Spot& spot, std::ptrdiff_t plane, const std::int64_t* limits,
                      std::int64_t* sums) {
  unsigned within = 0;
  std::vector<std::int64_t> own(looks(stencil.rows()));
  for (unsigned p = 0; p < 4; ++p) {
    within |=
        unsigned{HWY_NAMESPACE::compare(stencil, {spot.data + p * plane, spot.starts, spot.x}, limits, own.data())}
        << p;
    for (std::size_t look = 0; look < own.size(); ++look) sums[4 * look + p] = own[look];
  }
  return within;
}

std::uint16_t coarse_bounds(const CoarseRow& row, std::uint16_t* bounds) {
  std::uint16_t least = kNoRoom;
  for (int x = 0; x < row.groups; ++x) {
    bounds[x] = kNoRoom;
    if (row.room[x] < row.need) continue;
    int sum = 0;
    const std::uint8_t* target = row.targets;
    Bands bands(row, x);
    for (int b = 0; b < static_cast<int>(row.blocks->size()); ++b) {
      const CoarseBlock& block = (*row.blocks)[b];
      const std::uint8_t* from = block.planes + x;
      for (int s = 0; s < row.statistics; ++s, target += 2, from += 2 * block.plane_size) {
        const int off = std::max({0, from[0] - target[1], target[0] - from[block.plane_size]});
        sum = std::min(kNoRoom - 1, sum + (off * off >> block.shift));
      }
      if (std::uint16_t* to = bands.after(b)) *to = static_cast<std::uint16_t>(sum);
      if (sum > row.limit) break;
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

constexpr std::ptrdiff_t kLongRow = 1 << 13;  // bytes: four of them may be too much for a sum of 32 bits

using D8 = hn::CappedTag<std::uint8_t, Stencil::kVector>;
using D16 = hn::Repartition<std::int16_t, D8>;
using D32 = hn::RepartitionToWide<D16>;
using V8 = hn::Vec<D8>;
using V32 = hn::Vec<D32>;

// The sum, with the squared differences of a place where the mask is 255.
HWY_INLINE V32 add_squares(V8 value, V8 mask, V8 is, V32 sum) {
  const D16 d16;
  const D32 d32;
  const hn::RebindToUnsigned<D16> du16;
  const auto off = hn::And(hn::Or(hn::SaturatedSub(is, value), hn::SaturatedSub(value, is)), mask);
  const auto even = hn::And(hn::BitCast(d16, off), hn::Set(d16, 0xff));
  const auto odd = hn::BitCast(d16, hn::ShiftRight<8>(hn::BitCast(du16, off)));
  auto rest = hn::Zero(d32);
  sum = hn::ReorderWidenMulAccumulate(d32, even, even, sum, rest);
  sum = hn::ReorderWidenMulAccumulate(d32, odd, odd, sum, rest);
  return hn::Add(sum, rest);
}

// Bytes of a row of a stencil and those that they are compared with.
struct Stretch {
  const std::uint8_t *values, *mask, *from;

  Stretch at(std::ptrdiff_t i) const { return {values + i, mask + i, from + i}; }
};

// Sums of four places, whose bytes are `plane` apart.
struct FourSums {
  V32 a, b, c, d;

  template <class Load>
  HWY_INLINE void add(V8 value, V8 counts, std::ptrdiff_t plane, const Load& load) {
    a = add_squares(value, counts, load(0), a);
    b = add_squares(value, counts, load(plane), b);
    c = add_squares(value, counts, load(2 * plane), c);
    d = add_squares(value, counts, load(3 * plane), d);
  }
  HWY_INLINE void add(const Stretch& s, std::ptrdiff_t plane) {
    const D8 d8;
    add(hn::LoadU(d8, s.values), hn::LoadU(d8, s.mask), plane,
        [&](std::ptrdiff_t off) HWY_ATTR { return hn::LoadU(d8, s.from + off); });
  }
  // Of each the first half of a vector.
  HWY_INLINE void add(const Stretch& s, const Stretch& t, std::ptrdiff_t plane) {
    const D8 d8;
    const hn::Half<D8> half;
    const auto both = [&](const std::uint8_t* low, const std::uint8_t* high)
                          HWY_ATTR { return hn::Combine(d8, hn::LoadU(half, high), hn::LoadU(half, low)); };
    add(both(s.values, t.values), both(s.mask, t.mask), plane,
        [&](std::ptrdiff_t off) HWY_ATTR { return both(s.from + off, t.from + off); });
  }
};

HWY_INLINE std::int64_t total(V32 sum) { return hn::GetLane(hn::SumOfLanes(D32(), sum)); }

// Four totals at once: within each block of 128 bits the four vectors' lanes are brought together.
HWY_INLINE void add_totals(V32 a, V32 b, V32 c, V32 d, std::int64_t* all) {
  const D32 d32;
  const auto ac = hn::Add(hn::InterleaveLower(d32, a, c), hn::InterleaveUpper(d32, a, c));
  const auto bd = hn::Add(hn::InterleaveLower(d32, b, d), hn::InterleaveUpper(d32, b, d));
  HWY_ALIGN std::int32_t sums[Stencil::kVector / sizeof(std::int32_t)];
  hn::Store(hn::Add(hn::InterleaveLower(d32, ac, bd), hn::InterleaveUpper(d32, ac, bd)), d32, sums);
  for (std::size_t i = 0; i < hn::Lanes(d32); ++i) all[i % 4] += sums[i];
}

bool compare(const Stencil& stencil, const Spot& spot, const std::int64_t* limits, std::int64_t* sums) {
  const D8 d8;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d8));
  const std::uint8_t* values = stencil.values.data();
  const std::uint8_t* mask = stencil.mask.data();
  const int rows = stencil.rows(), step = stencil.stride < kLongRow ? kLook : 1;
  std::int64_t all = 0;
  for (int k = 0; k < rows;) {
    auto sum = hn::Zero(D32());
    for (const int end = std::min(rows, k + step); k < end; ++k, values += stencil.stride, mask += stencil.stride) {
      const std::uint8_t* from = spot.data + spot.starts[stencil.order[k]] + spot.x;
      for (std::ptrdiff_t i = stencil.begins[k] / lanes * lanes; i < stencil.ends[k]; i += lanes)
        sum = add_squares(hn::LoadU(d8, values + i), hn::LoadU(d8, mask + i), hn::LoadU(d8, from + i), sum);
    }
    all += total(sum);
    if (k % kLook != 0 && k < rows) continue;
    *sums++ = all;
    if (all > *limits++) return false;
  }
  return true;
}

unsigned compare_four(const Stencil& stencil, const Spot& spot, std::ptrdiff_t plane, const std::int64_t* limits,
                      std::int64_t* sums) {
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(D8()));
  Stretch row{stencil.values.data(), stencil.mask.data(), nullptr};
  const int rows = stencil.rows(), step = stencil.stride < kLongRow ? kLook : 1;
  std::int64_t all[4] = {0, 0, 0, 0};
  unsigned within = 15;
  for (int k = 0; k < rows;) {
    const auto zero = hn::Zero(D32());
    FourSums four{zero, zero, zero, zero};
    Stretch short_end{};  // of a row: half a vector or less, which waits for that of another one
    for (const int end = std::min(rows, k + step); k < end; ++k, row = row.at(stencil.stride)) {
      row.from = spot.data + spot.starts[stencil.order[k]] + spot.x;
      std::ptrdiff_t i = stencil.begins[k] / lanes * lanes;
      for (; i + lanes / 2 < stencil.ends[k]; i += lanes) four.add(row.at(i), plane);
      if (i >= stencil.ends[k]) continue;
      if (short_end.values)
        four.add(std::exchange(short_end, {}), row.at(i), plane);
      else
        short_end = row.at(i);
    }
    if (short_end.values) four.add(short_end, plane);
    add_totals(four.a, four.b, four.c, four.d, all);
    if (k % kLook != 0 && k < rows) continue;
    for (unsigned p = 0; p < 4; ++p) {
      *sums++ = all[p];
      within &= ~(unsigned{all[p] > *limits} << p);
    }
    ++limits;
    if (within == 0) break;
  }
  return within;
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
  const auto limit = hn::Set(d16, row.limit);
  const auto any_within = [&](auto a, auto b) {
    return !hn::AllFalse(d16, hn::Eq(hn::SaturatedSub(hn::Min(a, b), limit), hn::Zero(d16)));
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
    // Groups without room are above any limit from the start.
    const auto taken = hn::VecFromMask(d8, hn::Not(is_free));
    const auto taken_even = hn::VecFromMask(d16, hn::Eq(hn::And(hn::BitCast(d16, taken), byte), byte));
    const auto taken_odd = hn::VecFromMask(d16, hn::Eq(hn::ShiftRight<8>(hn::BitCast(d16, taken)), byte));
    auto even = taken_even, odd = taken_odd;
    const std::uint8_t* target = row.targets;
    Bands bands(row, x);
    for (int b = 0; b < static_cast<int>(row.blocks->size()); ++b) {
      const CoarseBlock& block = (*row.blocks)[b];
      const std::uint8_t* from = block.planes + x;
      for (int s = 0; s < row.statistics; ++s, target += 2, from += 2 * block.plane_size) {
        const auto low = hn::LoadU(d8, from), high = hn::LoadU(d8, from + block.plane_size);
        const auto off =
            hn::Max(hn::SaturatedSub(low, hn::Set(d8, target[1])), hn::SaturatedSub(hn::Set(d8, target[0]), high));
        even = hn::SaturatedAdd(even, hn::ShiftRightSame(square_even(off), block.shift));
        odd = hn::SaturatedAdd(odd, hn::ShiftRightSame(square_odd(off), block.shift));
      }
      if (std::uint16_t* to = bands.after(b)) hn::StoreInterleaved2(even, odd, d16, to);
      if (!any_within(even, odd)) break;
    }
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
    : stride(std::ptrdiff_t{(bytes + kVector - 1) / kVector} * kVector),
      order(std::move(rows)),
      begins(order.size()),
      ends(order.size()),
      values(static_cast<std::size_t>(stride) * order.size()),
      mask(values.size()) {}

void Stencil::set(int k, int i, std::uint8_t value) {
  values[k * stride + i] = value;
  mask[k * stride + i] = 255;
  begins[k] = ends[k] == 0 ? i : std::min(begins[k], i);
  ends[k] = std::max(ends[k], i + 1);
}

HWY_EXPORT(compare);
HWY_EXPORT(compare_four);
HWY_EXPORT(coarse_bounds);
HWY_EXPORT(find_at_most);

bool compare(const Stencil& stencil, const Spot& spot, const std::int64_t* limits, std::int64_t* sums) {
  return HWY_DYNAMIC_DISPATCH(compare)(stencil, spot, limits, sums);
}
unsigned compare_four(const Stencil& stencil, const Spot& spot, std::ptrdiff_t plane, const std::int64_t* limits,
                      std::int64_t* sums) {
  return HWY_DYNAMIC_DISPATCH(compare_four)(stencil, spot, plane, limits, sums);
}
std::uint16_t coarse_bounds(const CoarseRow& row, std::uint16_t* bounds) {
  return HWY_DYNAMIC_DISPATCH(coarse_bounds)(row, bounds);
}
void find_at_most(const std::uint16_t* bounds, int count, std::uint16_t limit, std::vector<int>& found) {
  HWY_DYNAMIC_DISPATCH(find_at_most)(bounds, count, limit, found);
}

}  // namespace tessera::parquetry
#endif

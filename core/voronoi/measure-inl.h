// Vectors of the kernels, and how they measure. Compiled once for each vector instruction set.
#if defined(TESSERA_VORONOI_MEASURE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_VORONOI_MEASURE_INL_H
#undef TESSERA_VORONOI_MEASURE_INL_H
#else
#define TESSERA_VORONOI_MEASURE_INL_H
#endif

#include <hwy/highway.h>

#include "tessera/voronoi/cpu_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, kBlockWidth>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(DF()));

inline unsigned bits_of(hn::Mask<DF> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(DF(), mask, bits);
  return bits[0];
}

// Distances and their squares have the same order; a metric's `key` is the cheaper one of them.
template <Metric metric>
struct Measure;

template <>
struct Measure<Metric::kFrustum> {
  static VF key(VF u, VF v, VF extent_u, VF extent_v) {
    const VF a = hn::Sub(hn::Abs(u), extent_u), b = hn::Sub(hn::Abs(v), extent_v);
    // The larger one with its sign: inside both are negative, and it alone counts.
    const VF most = hn::Max(a, b), least = hn::Max(hn::Min(a, b), hn::Zero(DF()));
    return hn::Add(hn::Mul(most, hn::Abs(most)), hn::Mul(least, least));
  }
  static float key_of_distance(float d) { return d < 0 ? -d * d : d * d; }
  // Good to 1 part in 2000, which bounds allow for.
  static VF distance_of_key(VF k) {
    const VF size = hn::Max(hn::Abs(k), hn::Set(DF(), 1e-12f));
    return hn::Mul(k, hn::ApproximateReciprocalSqrt(size));
  }
  // Largest change of distance a pixel.
  static VF slope(VF, VF) { return hn::Set(DF(), 1.0f); }
  // How far a site may be whose distance is at most d.
  static float search(float d, float r, float extent_max) { return d + r + extent_max; }
};

template <>
struct Measure<Metric::kChebyshev> {
  static VF key(VF u, VF v, VF extent_u, VF extent_v) {
    return hn::Max(hn::Div(hn::Abs(u), extent_u), hn::Div(hn::Abs(v), extent_v));
  }
  static float key_of_distance(float d) { return d; }
  static VF distance_of_key(VF k) { return k; }
  static VF slope(VF extent_u, VF extent_v) { return hn::Div(hn::Set(DF(), 1.0f), hn::Min(extent_u, extent_v)); }
  static float search(float d, float r, float extent_max) { return d * extent_max + r; }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif

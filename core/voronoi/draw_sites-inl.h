// The nearest sites of pixels by drawing: every site into the pixels of its box, nearer ones over farther ones.
//
// A site's box holds all pixels that may be within `near` of it, so a pixel with a site within `near` has its nearest
// one drawn. Pixels without are left unlabelled.
#if defined(TESSERA_VORONOI_DRAW_SITES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_VORONOI_DRAW_SITES_INL_H
#undef TESSERA_VORONOI_DRAW_SITES_INL_H
#else
#define TESSERA_VORONOI_DRAW_SITES_INL_H
#endif

#include <algorithm>
#include <cstring>

#include "tessera/voronoi/measure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

template <Metric metric>
class Drawing {
  using M = Measure<metric>;

 public:
  explicit Drawing(const KernelArguments& arguments) : arg_(arguments), bins_(*arguments.bins) {}

  // Labels what is near a site in the tile at (x0, y0), kUnlabelled the rest of it.
  void draw(int x0, int y0) {
    x0_ = x0;
    y0_ = y0;
    clear();
    const std::uint8_t zone = zone_row(0)[0];
    if (has_one_zone(zone)) {
      draw_bins<false>(zone);
    } else {
      draw_bins<true>(zone);
    }
    copy_labels();
  }

  // Whether pixels of a rectangle of the tile are unlabelled; it is whole vectors wide.
  bool has_unlabelled(int x, int y, int width, int height) const {
    const DI di;
    VI least = hn::Zero(di);
    for (int j = y; j < y + height; ++j)
      for (int i = x; i < x + width; i += kLanes) least = hn::Min(least, hn::Load(di, label_ + j * kStride + i));
    return !hn::AllFalse(di, hn::Lt(least, hn::Zero(di)));
  }

 private:
  // Rows are longer than the tile, so that a vector may begin at any of its pixels.
  static constexpr int kStride = kTileWidth + 2 * kBlockWidth;

  const std::uint8_t* zone_row(int y) const { return arg_.zones + (y0_ + y) * arg_.zones_stride + x0_; }

  bool has_one_zone(std::uint8_t zone) const {
    std::uint8_t row[kTileWidth];
    std::memset(row, zone, sizeof row);
    for (int y = 0; y < kTileHeight; ++y)
      if (std::memcmp(zone_row(y), row, sizeof row) != 0) return false;
    return true;
  }

  // Half the side of a site's box, from half the side of its cap's.
  float box(float cap) const { return cap * arg_.near.scale + arg_.near.margin; }
  VF box(VF cap) const {
    return hn::Add(hn::Mul(cap, hn::Set(DF(), arg_.near.scale)), hn::Set(DF(), arg_.near.margin));
  }

  // From units of the bins to pixels.
  static float offset(std::int32_t subpixels) { return static_cast<float>(subpixels) * (1.0f / kSubpixels); }

  void clear() {
    const DF d;
    const DI di;
    // No label is lower than kUnlabelled: what is as far as `near` stays out.
    const VF near = hn::Set(d, M::key_of_distance(arg_.near.distance));
    const VI none = hn::Set(di, kUnlabelled);
    for (int i = 0; i < kTileHeight * kStride; i += kLanes) {
      hn::Store(near, d, key_ + i);
      hn::Store(none, di, label_ + i);
    }
  }

  // The pixels [left, right) x [top, bottom) of the tile that a vector of sites may label.
  struct Boxes {
    HWY_ALIGN std::int32_t left[kBlockWidth], right[kBlockWidth], top[kBlockWidth], bottom[kBlockWidth];
  };

  // Centre and half side of boxes along one axis to pixels from `begin` to `end`; true where there are any.
  static hn::Mask<DF> clip(VF centre, VF half, int size, std::int32_t* begin, std::int32_t* end) {
    const DF d;
    const VF zero = hn::Zero(d), last = hn::Set(d, static_cast<float>(size));
    const VF from = hn::Add(hn::Sub(centre, half), hn::Set(d, 0.5f)),
             to = hn::Add(hn::Add(centre, half), hn::Set(d, 0.5f));
    const VI first = hn::ConvertTo(DI(), hn::Min(hn::Max(from, zero), last));
    const VI past = hn::ConvertTo(DI(), hn::Min(hn::Max(to, zero), last));
    hn::Store(first, DI(), begin);
    hn::Store(past, DI(), end);
    return hn::RebindMask(d, hn::Lt(first, past));
  }

  template <bool kMixedZones>
  void draw_bins(std::uint8_t zone) {
    const DF d;
    const DI di;
    const float range = box(bins_.box_max);
    const int left = bins_.bin_of(x0_ - range, bins_.columns),
              right = bins_.bin_of(x0_ + kTileWidth + range, bins_.columns);
    const int top = bins_.bin_of(y0_ - range, bins_.rows),
              bottom = bins_.bin_of(y0_ + kTileHeight + range, bins_.rows);
    const VI origin_x = hn::Set(di, x0_ * kSubpixels), origin_y = hn::Set(di, y0_ * kSubpixels);
    const VF scale = hn::Set(d, 1.0f / kSubpixels);
    Boxes boxes;
    for (int row = top; row <= bottom; ++row) {
      const int begin = bins_.first[row * bins_.columns + left], end = bins_.first[row * bins_.columns + right + 1];
      for (int k = begin; k < end; k += kLanes) {
        const VF x = hn::Mul(hn::ConvertTo(d, hn::Sub(hn::LoadU(di, &bins_.x[k]), origin_x)), scale);
        const VF y = hn::Mul(hn::ConvertTo(d, hn::Sub(hn::LoadU(di, &bins_.y[k]), origin_y)), scale);
        const auto across = clip(x, box(hn::LoadU(d, &bins_.box_x[k])), kTileWidth, boxes.left, boxes.right);
        const auto down = clip(y, box(hn::LoadU(d, &bins_.box_y[k])), kTileHeight, boxes.top, boxes.bottom);
        auto touching = hn::And(hn::And(across, down), hn::FirstN(d, static_cast<std::size_t>(end - k)));
        if constexpr (!kMixedZones)
          touching = hn::And(touching, hn::RebindMask(d, hn::Eq(hn::LoadU(di, &bins_.zone[k]), hn::Set(di, zone))));
        for (unsigned rest = bits_of(touching); rest; rest &= rest - 1) {
          const int i = __builtin_ctz(rest);
          draw_site<kMixedZones>(k + i, boxes.left[i], boxes.right[i], boxes.top[i], boxes.bottom[i]);
        }
      }
    }
  }

  template <bool kMixedZones>
  void draw_site(int k, int left, int right, int top, int bottom) {
    int x = left;
    for (; x + kLanes < right; x += 2 * kLanes) draw_columns<kMixedZones, 2>(k, x, top, bottom);
    if (x < right) draw_columns<kMixedZones, 1>(k, x, top, bottom);
  }

  // Some vectors beside each other, from x on.
  template <bool kMixedZones, int kColumns>
  void draw_columns(int k, int x, int top, int bottom) {
    const DF d;
    const DI di;
    const VF cs = hn::Set(d, bins_.cosine[k]), sn = hn::Set(d, bins_.sine[k]);
    const VF eu = hn::Set(d, bins_.extent_u[k]), ev = hn::Set(d, bins_.extent_v[k]);
    const VI id = hn::Set(di, bins_.id[k]), zone = hn::Set(di, bins_.zone[k]);
    const VF dx = hn::Add(hn::Iota(d, 0.5f), hn::Set(d, offset((x0_ + x) * kSubpixels - bins_.x[k])));
    const VF dx1 = hn::Add(dx, hn::Set(d, static_cast<float>(kLanes)));
    const VF cdx[] = {hn::Mul(cs, dx), hn::Mul(cs, dx1)}, sdx[] = {hn::Mul(sn, dx), hn::Mul(sn, dx1)};
    VF dy = hn::Set(d, offset((y0_ + top) * kSubpixels - bins_.y[k]) + 0.5f);
    float* keys = key_ + top * kStride + x;
    std::int32_t* labels = label_ + top * kStride + x;
    for (int y = top; y < bottom; ++y, keys += kStride, labels += kStride) {
      const VF cdy = hn::Mul(cs, dy), sdy = hn::Mul(sn, dy);
      for (int i = 0; i < kColumns; ++i) {
        const VF key = M::key(hn::Add(cdx[i], sdy), hn::Sub(cdy, sdx[i]), eu, ev);
        const VF best = hn::LoadU(d, keys + i * kLanes);
        const VI label = hn::LoadU(di, labels + i * kLanes);
        auto closer = hn::Or(hn::Lt(key, best), hn::And(hn::Eq(key, best), hn::RebindMask(d, hn::Lt(id, label))));
        if constexpr (kMixedZones) {
          const hn::Rebind<std::uint8_t, DI> d8;
          const VI zones = hn::PromoteTo(di, hn::LoadU(d8, zone_row(y) + x + i * kLanes));
          closer = hn::And(closer, hn::RebindMask(d, hn::Eq(zones, zone)));
        }
        hn::StoreU(hn::IfThenElse(closer, key, best), d, keys + i * kLanes);
        hn::StoreU(hn::IfThenElse(hn::RebindMask(di, closer), id, label), di, labels + i * kLanes);
      }
      dy = hn::Add(dy, hn::Set(d, 1.0f));
    }
  }

  void copy_labels() const {
    const int rows = std::min(kTileHeight, arg_.height - y0_), columns = std::min(kTileWidth, arg_.width - x0_);
    for (int y = 0; y < rows; ++y)
      std::memcpy(arg_.labels + (y0_ + y) * arg_.labels_stride + x0_, label_ + y * kStride,
                  columns * sizeof(std::int32_t));
  }

  const KernelArguments& arg_;
  const SiteBins& bins_;
  int x0_ = 0, y0_ = 0;
  HWY_ALIGN float key_[kTileHeight * kStride];
  HWY_ALIGN std::int32_t label_[kTileHeight * kStride];
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif

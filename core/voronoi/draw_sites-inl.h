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
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "tessera/voronoi/measure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

// A set of numbers, taken out in ascending order: a bit each.
class Marks {
 public:
  explicit Marks(std::size_t size) : words_(size / 64 + 1, 0), first_(static_cast<int>(words_.size())) {}

  void add(int i) {
    const int word = i / 64;
    words_[word] |= std::uint64_t{1} << i % 64;
    first_ = std::min(first_, word);
    last_ = std::max(last_, word);
  }

  template <class Visit>
  void take_all(const Visit& visit) {
    for (int word = first_; word <= last_; ++word) {
      for (std::uint64_t rest = words_[word]; rest != 0; rest &= rest - 1) visit(word * 64 + __builtin_ctzll(rest));
      words_[word] = 0;
    }
    first_ = static_cast<int>(words_.size());
    last_ = -1;
  }

 private:
  std::vector<std::uint64_t> words_;
  int first_, last_ = -1;  // the words that are not 0
};

template <Metric metric>
class Drawing {
  using M = Measure<metric>;

 public:
  explicit Drawing(const KernelArguments& arguments)
      : arg_(arguments), bins_(*arguments.bins), marks_(bins_.place.size()) {}

  // Labels what is near a site in the tile at (x0, y0), kUnlabelled the rest of it.
  void draw(int x0, int y0) {
    x0_ = x0;
    y0_ = y0;
    clear();
    const std::uint8_t zone = zone_row(0)[0];
    // In the order of their index: of equally near sites the first stays.
    if (has_mixed_zones()) {
      find_sites<true>(zone);
      marks_.take_all([&](int id) { draw_site<true>(bins_.place[id]); });
    } else {
      find_sites<false>(zone);
      marks_.take_all([&](int id) { draw_site<false>(bins_.place[id]); });
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
  static constexpr std::ptrdiff_t kStride = kTileWidth + kTilePadding;

  const std::uint8_t* zone_row(int y) const { return arg_.zones + (y0_ + y) * arg_.zones_stride + x0_; }

  bool has_mixed_zones() const {
    const int columns = (arg_.width + kTileWidth - 1) / kTileWidth;
    return arg_.mixed_tiles[y0_ / kTileHeight * columns + x0_ / kTileWidth] != 0;
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

  // Marks the sites whose boxes touch the tile; where it has one zone, of that zone only.
  template <bool kMixedZones>
  void find_sites(std::uint8_t zone) {
    const DF d;
    const DI di;
    const float range = box(bins_.box_max);
    const int left = bins_.bin_of(x0_ - range, bins_.columns);
    const int right = bins_.bin_of(x0_ + kTileWidth + range, bins_.columns);
    const int top = bins_.bin_of(y0_ - range, bins_.rows),
              bottom = bins_.bin_of(y0_ + kTileHeight + range, bins_.rows);
    for (int row = top; row <= bottom; ++row) {
      const int begin = bins_.first[row * bins_.columns + left], end = bins_.first[row * bins_.columns + right + 1];
      for (int k = begin; k < end; k += kLanes) {
        auto touching = hn::And(touches(&bins_.x[k], &bins_.box_x[k], x0_, kTileWidth),
                                touches(&bins_.y[k], &bins_.box_y[k], y0_, kTileHeight));
        touching = hn::And(touching, hn::FirstN(d, static_cast<std::size_t>(end - k)));
        if constexpr (!kMixedZones)
          touching = hn::And(touching, hn::RebindMask(d, hn::Eq(hn::LoadU(di, &bins_.zone[k]), hn::Set(di, zone))));
        for (unsigned rest = bits_of(touching); rest; rest &= rest - 1) marks_.add(bins_.id[k + __builtin_ctz(rest)]);
      }
    }
  }

  // Which of a vector of boxes, along one axis, touch the tile's pixels from `begin` on.
  hn::Mask<DF> touches(const std::int32_t* centre, const float* cap, int begin, int size) const {
    const DF d;
    const DI di;
    const float half = 0.5f * static_cast<float>(size);
    const VI middle = hn::Set(di, begin * kSubpixels + size * (kSubpixels / 2));
    const VF off = hn::Mul(hn::ConvertTo(d, hn::Sub(hn::LoadU(di, centre), middle)), hn::Set(d, 1.0f / kSubpixels));
    return hn::Lt(hn::Abs(off), hn::Add(box(hn::LoadU(d, cap)), hn::Set(d, half)));
  }

  // The pixels of the tile, along one axis, whose centres lie in a box.
  struct Span {
    int begin, end;
    Span(float centre, float half, int size)
        : begin(static_cast<int>(std::clamp(centre - half + 0.5f, 0.0f, static_cast<float>(size)))),
          end(static_cast<int>(std::clamp(centre + half + 0.5f, 0.0f, static_cast<float>(size)))) {}
  };

  template <bool kMixedZones>
  void draw_site(int k) {
    const Span columns(offset(bins_.x[k] - x0_ * kSubpixels), box(bins_.box_x[k]), kTileWidth);
    const Span rows(offset(bins_.y[k] - y0_ * kSubpixels), box(bins_.box_y[k]), kTileHeight);
    int x = columns.begin;
    for (; x + kLanes < columns.end; x += 2 * kLanes) draw_columns<kMixedZones, 2>(k, x, rows);
    if (x < columns.end) draw_columns<kMixedZones, 1>(k, x, rows);
  }

  // Some vectors beside each other, from x on.
  template <bool kMixedZones, int kColumns>
  void draw_columns(int k, int x, Span rows) {
    const DF d;
    const DI di;
    const VF cs = hn::Set(d, bins_.cosine[k]), sn = hn::Set(d, bins_.sine[k]);
    const VF eu = hn::Set(d, bins_.extent_u[k]), ev = hn::Set(d, bins_.extent_v[k]);
    const VI id = hn::Set(di, bins_.id[k]), zone = hn::Set(di, bins_.zone[k]);
    const VF dx = hn::Add(hn::Iota(d, 0.5f), hn::Set(d, offset((x0_ + x) * kSubpixels - bins_.x[k])));
    const VF dx1 = hn::Add(dx, hn::Set(d, static_cast<float>(kLanes)));
    const VF cdx[] = {hn::Mul(cs, dx), hn::Mul(cs, dx1)}, sdx[] = {hn::Mul(sn, dx), hn::Mul(sn, dx1)};
    VF dy = hn::Set(d, offset((y0_ + rows.begin) * kSubpixels - bins_.y[k]) + 0.5f);
    float* keys = key_ + rows.begin * kStride + x;
    std::int32_t* labels = label_ + rows.begin * kStride + x;
    for (int y = rows.begin; y < rows.end; ++y, keys += kStride, labels += kStride) {
      const VF cdy = hn::Mul(cs, dy), sdy = hn::Mul(sn, dy);
      for (std::ptrdiff_t i = 0; i < kColumns; ++i) {
        const VF key = M::key(hn::Add(cdx[i], sdy), hn::Sub(cdy, sdx[i]), eu, ev);
        const VF best = hn::LoadU(d, keys + i * kLanes);
        auto closer = hn::Lt(key, best);
        if constexpr (kMixedZones) {
          const hn::Rebind<std::uint8_t, DI> d8;
          const VI zones = hn::PromoteTo(di, hn::LoadU(d8, zone_row(y) + x + i * kLanes));
          closer = hn::And(closer, hn::RebindMask(d, hn::Eq(zones, zone)));
        }
        hn::StoreU(hn::IfThenElse(closer, key, best), d, keys + i * kLanes);
        const VI label = hn::LoadU(di, labels + i * kLanes);
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
  Marks marks_;
  int x0_ = 0, y0_ = 0;
  HWY_ALIGN float key_[kTileHeight * kStride];
  HWY_ALIGN std::int32_t label_[kTileHeight * kStride];
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif

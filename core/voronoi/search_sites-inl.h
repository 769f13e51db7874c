// The nearest sites of pixels by search: for those that drawing left.
//
// Distances are 1-Lipschitz up to a site's slope, so a site can win a pixel within radius r of a centre only if its
// distance there is at most the least one plus 2 r times the slope. That bound picks the candidates of a tile from
// the bins, then those of each block from the tile's; only they are compared pixel by pixel.
#if defined(TESSERA_VORONOI_SEARCH_SITES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_VORONOI_SEARCH_SITES_INL_H
#undef TESSERA_VORONOI_SEARCH_SITES_INL_H
#else
#define TESSERA_VORONOI_SEARCH_SITES_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "tessera/voronoi/measure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

// Largest distance from a tile's or block's centre to a pixel centre in it.
inline float radius(int width, int height) { return 0.5f * std::hypot(width - 1.0f, height - 1.0f); }

// For each mask the lanes that it keeps, in order, at the front. (Highway's own Compress copies its table at each
// call when GCC compiles it.)
struct KeepTable {
  std::int32_t lanes[1 << kLanes][kLanes] = {};
  constexpr KeepTable() {
    for (int mask = 0; mask < 1 << kLanes; ++mask) {
      int n = 0;
      for (int lane = 0; lane < kLanes; ++lane)
        if (mask >> lane & 1) lanes[mask][n++] = lane;
    }
  }
};
constexpr KeepTable kKeep;

// Candidates of a tile, positions relative to its top left corner; padded for vectors.
struct Candidates {
  std::vector<float> x, y, cosine, sine, extent_u, extent_v;
  std::vector<std::int32_t> zone, id;
  int count = 0;

  void reserve(int n) {
    if (x.size() >= static_cast<std::size_t>(n) + kBlockWidth) return;
    for (auto* a : {&x, &y, &cosine, &sine, &extent_u, &extent_v}) a->resize(2 * n + kBlockWidth);
    for (auto* a : {&zone, &id}) a->resize(2 * n + kBlockWidth);
  }
};

// For each candidate the least and the largest distance that any pixel around a centre may have from it.
struct Bounds {
  std::vector<float> lower, upper;
  int count = 0;
  void resize(int n) {
    count = n;
    if (lower.size() >= static_cast<std::size_t>(n) + kBlockWidth) return;
    lower.resize(2 * n + kBlockWidth);
    upper.resize(2 * n + kBlockWidth);
  }
};

template <Metric metric>
class Search {
  using M = Measure<metric>;

 public:
  explicit Search(const KernelArguments& arguments) : arg_(arguments), bins_(*arguments.bins) {}

  // Labels the unlabelled pixels of the tile at (x0, y0), as far as they have a site within reach.
  void complete(int x0, int y0) {
    x0_ = x0;
    y0_ = y0;
    if (x0 >= arg_.width || y0 >= arg_.height) return;
    gather();
    for (int y = 0; y < kSearchHeight; y += kBlockHeight)
      for (int x = 0; x < kSearchWidth; x += kBlockWidth)
        if (has_unlabelled(x, y)) label_block(x, y);
  }

 private:
  // Whether pixels of the block at (x, y) are unlabelled.
  bool has_unlabelled(int x, int y) const {
    const int right = std::min(x0_ + x + kBlockWidth, arg_.width),
              bottom = std::min(y0_ + y + kBlockHeight, arg_.height);
    for (int j = y0_ + y; j < bottom; ++j) {
      const std::int32_t* row = arg_.labels + j * arg_.labels_stride;
      for (int i = x0_ + x; i < right; ++i)
        if (row[i] == kUnlabelled) return true;
    }
    return false;
  }

  // Zones of a rectangle of the tile: `only` is the zone where there is but one, else -1 and `present` marks them.
  struct ZoneSet {
    int only = -1;
    bool present[256];
  };

  const std::uint8_t* zone_row(int x, int y) const { return arg_.zones + (y0_ + y) * arg_.zones_stride + x0_ + x; }

  void zones_of(int x, int y, int width, int height, ZoneSet& set) const {
    const std::uint8_t zone = zone_row(x, y)[0];
    bool same = true;
    for (int j = 0; j < height && same; ++j) {
      std::uint8_t pattern[kSearchWidth];
      std::memset(pattern, zone, sizeof pattern);
      same = std::memcmp(zone_row(x, y + j), pattern, width) == 0;
    }
    set.only = same ? zone : -1;
    if (same) return;
    std::memset(set.present, 0, sizeof set.present);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i) set.present[zone_row(x, y + j)[i]] = true;
  }

  // Distance of a vector of sites from a point, and from it the bounds for all pixels within r of the point: a little
  // wide, for the distance is rounded.
  static void bounds_at(VF dx, VF dy, VF cs, VF sn, VF eu, VF ev, float r, VF& lower, VF& upper) {
    const VF u = hn::Add(hn::Mul(cs, dx), hn::Mul(sn, dy)), v = hn::Sub(hn::Mul(cs, dy), hn::Mul(sn, dx));
    const VF distance = M::distance_of_key(M::key(u, v, eu, ev));
    const VF rounding = hn::Mul(hn::Abs(distance), hn::Set(DF(), 1.0f / 1024));
    const VF change = hn::Add(hn::Mul(M::slope(eu, ev), hn::Set(DF(), r)), rounding);
    lower = hn::Sub(distance, change);
    upper = hn::Add(distance, change);
  }

  // For each zone present the least distance within which every pixel of it has a site, or the reach. `largest` of
  // them.
  struct Limits {
    float of_zone[256];
    float largest;
  };

  template <class ZoneAt>
  void find_limits(const Bounds& bounds, const ZoneSet& zones, const ZoneAt& zone_at, Limits& limits) const {
    constexpr float kRounding = 1.0f / 512;  // of the bounds themselves
    if (zones.only >= 0) {
      const DF d;
      VF least = hn::Set(d, arg_.reach);
      for (int k = 0; k < bounds.count; k += kLanes) least = hn::Min(least, hn::LoadU(d, &bounds.upper[k]));
      limits.largest = limits.of_zone[zones.only] = hn::GetLane(hn::MinOfLanes(d, least)) + kRounding;
      return;
    }
    for (int z = 0; z < 256; ++z) limits.of_zone[z] = zones.present[z] ? arg_.reach + kRounding : -1e30f;
    for (int k = 0; k < bounds.count; ++k) {
      const int zone = zone_at(k);
      if (zone >= 0) limits.of_zone[zone] = std::min(limits.of_zone[zone], bounds.upper[k] + kRounding);
    }
    limits.largest = *std::max_element(limits.of_zone, limits.of_zone + 256);
  }

  // Fills `tile_` with the sites that may win a pixel of the tile, searching bins outwards until no farther site can.
  void gather() {
    const float r = radius(kSearchWidth, kSearchHeight);
    const float farthest = M::search(arg_.reach, r, bins_.extent_max);
    zones_of(0, 0, kSearchWidth, kSearchHeight, zones_);
    float range = std::min(farthest, static_cast<float>(2.5 * bins_.bin) + bins_.extent_max);
    for (;;) {
      look_around(range, r);
      find_limits(
          bounds_, zones_, [&](int k) { return zone_of_[k]; }, limits_);
      const float wanted = std::min(farthest, M::search(limits_.largest, 0, bins_.extent_max) + r);
      if (wanted <= range) break;
      range = wanted;
    }
    keep_candidates();
  }

  // Bounds, for the whole tile, of all sites in the bins within `range` of its centre. Rows of bins are padded to
  // whole vectors; the padding and sites of other zones have bounds that nobody passes, and zone -1.
  void look_around(float range, float r) {
    const DF d;
    const DI di;
    const double cx = x0_ + 0.5 * kSearchWidth, cy = y0_ + 0.5 * kSearchHeight;
    const int left = bins_.bin_of(cx - range, bins_.columns), right = bins_.bin_of(cx + range, bins_.columns);
    const int top = bins_.bin_of(cy - range, bins_.rows), bottom = bins_.bin_of(cy + range, bins_.rows);
    const VI centre_x = hn::Set(di, x0_ * kSubpixels + kSearchWidth * kSubpixels / 2);
    const VI centre_y = hn::Set(di, y0_ * kSubpixels + kSearchHeight * kSubpixels / 2);
    const VF scale = hn::Set(d, 1.0f / kSubpixels), far = hn::Set(d, 1e30f);
    int count = 0;
    rows_.clear();
    for (int row = top; row <= bottom; ++row) {
      const int begin = bins_.first[row * bins_.columns + left], end = bins_.first[row * bins_.columns + right + 1];
      rows_.push_back({begin, end});
      bounds_.resize(count + end - begin + kLanes);
      if (zone_of_.size() < bounds_.lower.size()) zone_of_.resize(bounds_.lower.size());
      for (int k = begin; k < end; k += kLanes, count += kLanes) {
        VF lower, upper;
        bounds_at(hn::Mul(scale, hn::ConvertTo(d, hn::Sub(centre_x, hn::LoadU(di, &bins_.x[k])))),
                  hn::Mul(scale, hn::ConvertTo(d, hn::Sub(centre_y, hn::LoadU(di, &bins_.y[k])))),
                  hn::LoadU(d, &bins_.cosine[k]), hn::LoadU(d, &bins_.sine[k]), hn::LoadU(d, &bins_.extent_u[k]),
                  hn::LoadU(d, &bins_.extent_v[k]), r, lower, upper);
        const VI zone = hn::LoadU(di, &bins_.zone[k]);
        auto valid = hn::FirstN(di, static_cast<std::size_t>(end - k));
        if (zones_.only >= 0) valid = hn::And(valid, hn::Eq(zone, hn::Set(di, zones_.only)));
        const auto valid_f = hn::RebindMask(d, valid);
        hn::StoreU(hn::IfThenElse(valid_f, lower, far), d, &bounds_.lower[count]);
        hn::StoreU(hn::IfThenElse(valid_f, upper, far), d, &bounds_.upper[count]);
        hn::StoreU(hn::IfThenElse(valid, zone, hn::Set(di, -1)), di, &zone_of_[count]);
      }
    }
    bounds_.count = count;
  }

  // Copies the sites of `rows_` that pass their zone's limit into `tile_`.
  void keep_candidates() {
    const DF d;
    const DI di;
    tile_.reserve(bounds_.count);
    const VI origin_x = hn::Set(di, x0_ * kSubpixels), origin_y = hn::Set(di, y0_ * kSubpixels);
    const VF scale = hn::Set(d, 1.0f / kSubpixels);
    int from = 0, n = 0;
    for (const auto& [begin, end] : rows_) {
      for (int k = begin; k < end; k += kLanes, from += kLanes) {
        const unsigned kept = bits_of(passes(from));
        const auto order = hn::SetTableIndices(d, kKeep.lanes[kept]);
        const auto order_i = hn::SetTableIndices(di, kKeep.lanes[kept]);
        const VI x = hn::Sub(hn::LoadU(di, &bins_.x[k]), origin_x), y = hn::Sub(hn::LoadU(di, &bins_.y[k]), origin_y);
        // Whole vectors are stored: what lies beyond the kept ones is overwritten by the next.
        hn::StoreU(hn::TableLookupLanes(hn::Mul(hn::ConvertTo(d, x), scale), order), d, &tile_.x[n]);
        hn::StoreU(hn::TableLookupLanes(hn::Mul(hn::ConvertTo(d, y), scale), order), d, &tile_.y[n]);
        hn::StoreU(hn::TableLookupLanes(hn::LoadU(d, &bins_.cosine[k]), order), d, &tile_.cosine[n]);
        hn::StoreU(hn::TableLookupLanes(hn::LoadU(d, &bins_.sine[k]), order), d, &tile_.sine[n]);
        hn::StoreU(hn::TableLookupLanes(hn::LoadU(d, &bins_.extent_u[k]), order), d, &tile_.extent_u[n]);
        hn::StoreU(hn::TableLookupLanes(hn::LoadU(d, &bins_.extent_v[k]), order), d, &tile_.extent_v[n]);
        hn::StoreU(hn::TableLookupLanes(hn::LoadU(di, &bins_.zone[k]), order_i), di, &tile_.zone[n]);
        hn::StoreU(hn::TableLookupLanes(hn::LoadU(di, &bins_.id[k]), order_i), di, &tile_.id[n]);
        n += __builtin_popcount(kept);
      }
    }
    tile_.count = n;
  }

  // Which of a vector of the bounds from `at` on pass their zone's limit.
  hn::Mask<DF> passes(int at) const {
    const DF d;
    if (zones_.only >= 0) return hn::Le(hn::LoadU(d, &bounds_.lower[at]), hn::Set(d, limits_.largest));
    float limit[kBlockWidth];
    for (int i = 0; i < kLanes; ++i) limit[i] = zone_of_[at + i] >= 0 ? limits_.of_zone[zone_of_[at + i]] : -1e30f;
    return hn::Le(hn::LoadU(d, &bounds_.lower[at]), hn::LoadU(d, limit));
  }

  // Bounds of the tile's candidates for the block at (x, y).
  void narrow(int x, int y, float r) {
    const DF d;
    bounds_.resize(tile_.count);
    const VF px = hn::Set(d, x + 0.5f * kBlockWidth), py = hn::Set(d, y + 0.5f * kBlockHeight);
    for (int k = 0; k < tile_.count; k += kLanes) {
      VF lower, upper;
      bounds_at(hn::Sub(px, hn::LoadU(d, &tile_.x[k])), hn::Sub(py, hn::LoadU(d, &tile_.y[k])),
                hn::LoadU(d, &tile_.cosine[k]), hn::LoadU(d, &tile_.sine[k]), hn::LoadU(d, &tile_.extent_u[k]),
                hn::LoadU(d, &tile_.extent_v[k]), r, lower, upper);
      const auto valid = hn::FirstN(d, static_cast<std::size_t>(tile_.count - k));
      hn::StoreU(hn::IfThenElse(valid, lower, hn::Set(d, 1e30f)), d, &bounds_.lower[k]);
      hn::StoreU(hn::IfThenElse(valid, upper, hn::Set(d, 1e30f)), d, &bounds_.upper[k]);
    }
  }

  void label_block(int x, int y) {
    const float r = radius(kBlockWidth, kBlockHeight);
    ZoneSet& zones = block_zones_;
    zones.only = zones_.only;
    if (zones.only < 0) zones_of(x, y, kBlockWidth, kBlockHeight, zones);
    narrow(x, y, r);
    // A tile of several zones has candidates of all of them; a block of one zone must not take the others'.
    if (zones.only >= 0 && zones_.only < 0) exclude_other_zones(zones.only);
    winner_count_ = 0;
    if (winners_.size() < tile_.x.size()) winners_.resize(tile_.x.size());
    find_limits(
        bounds_, zones, [&](int k) { return tile_.zone[k]; }, limits_);
    const DF d;
    for (int k = 0; k < tile_.count; k += kLanes) {
      if (zones.only >= 0) {
        unsigned rest = bits_of(hn::Le(hn::LoadU(d, &bounds_.lower[k]), hn::Set(d, limits_.largest)));
        for (; rest; rest &= rest - 1) winners_[winner_count_++] = k + __builtin_ctz(rest);
      } else {
        for (int i = k; i < std::min(k + kLanes, tile_.count); ++i)
          if (bounds_.lower[i] <= limits_.of_zone[tile_.zone[i]]) winners_[winner_count_++] = i;
      }
    }

    std::int32_t* target = arg_.labels + (y0_ + y) * arg_.labels_stride + x0_ + x;
    const int columns = std::min(kBlockWidth, arg_.width - x0_ - x),
              rows = std::min(kBlockHeight, arg_.height - y0_ - y);
    if (columns == kBlockWidth && rows == kBlockHeight) {
      compare(x, y, zones, target, arg_.labels_stride);
      return;
    }
    std::int32_t labels[kBlockHeight][kBlockWidth];
    compare(x, y, zones, labels[0], kBlockWidth);
    for (int j = 0; j < rows; ++j) std::copy_n(labels[j], columns, target + j * arg_.labels_stride);
  }

  void compare(int x, int y, const ZoneSet& zones, std::int32_t* labels, std::ptrdiff_t stride) const {
    for (int column = 0; column < kBlockWidth; column += kLanes) {
      if (zones.only >= 0) {
        label_column<false>(x + column, y, labels + column, stride);
      } else {
        label_column<true>(x + column, y, labels + column, stride);
      }
    }
  }

  void exclude_other_zones(int zone) {
    for (int k = 0; k < tile_.count; ++k)
      if (tile_.zone[k] != zone) bounds_.lower[k] = bounds_.upper[k] = 1e30f;
  }

  // One vector wide, the block's rows in registers.
  template <bool kMixedZones>
  void label_column(int x, int y, std::int32_t* labels, std::ptrdiff_t stride) const {
    static_assert(kBlockHeight == 4);
    const DF d;
    const DI di;
    const VF reach = hn::Set(d, M::key_of_distance(arg_.reach));
    // No label is lower than kUnlabelled: what is as far as the reach stays out.
    const VI none = hn::Set(di, kUnlabelled);
    VF best0 = reach, best1 = reach, best2 = reach, best3 = reach;
    VI label0 = none, label1 = none, label2 = none, label3 = none;
    const VF px = hn::Add(hn::Iota(d, 0.0f), hn::Set(d, x + 0.5f));
    for (int w = 0; w < winner_count_; ++w) {
      const int k = winners_[w];
      const VF eu = hn::Set(d, tile_.extent_u[k]), ev = hn::Set(d, tile_.extent_v[k]);
      const VI id = hn::Set(di, tile_.id[k]);
      const float cs = tile_.cosine[k], sn = tile_.sine[k];
      const VF dx = hn::Sub(px, hn::Set(d, tile_.x[k]));
      const VF cdx = hn::Mul(hn::Set(d, cs), dx), sdx = hn::Mul(hn::Set(d, sn), dx);
      const float dy = y + 0.5f - tile_.y[k];
      const auto row = [&](int j, VF& best, VI& label) HWY_ATTR {
        const VF u = hn::Add(cdx, hn::Set(d, sn * (dy + j))), v = hn::Sub(hn::Set(d, cs * (dy + j)), sdx);
        const VF key = M::key(u, v, eu, ev);
        auto closer = hn::Or(hn::Lt(key, best), hn::And(hn::Eq(key, best), hn::RebindMask(d, hn::Lt(id, label))));
        if constexpr (kMixedZones) {
          const VI zone = zone_vector(x, y + j);
          closer = hn::And(closer, hn::RebindMask(d, hn::Eq(zone, hn::Set(di, tile_.zone[k]))));
        }
        best = hn::IfThenElse(closer, key, best);
        label = hn::IfThenElse(hn::RebindMask(di, closer), id, label);
      };
      row(0, best0, label0);
      row(1, best1, label1);
      row(2, best2, label2);
      row(3, best3, label3);
    }
    hn::StoreU(label0, di, labels);
    hn::StoreU(label1, di, labels + stride);
    hn::StoreU(label2, di, labels + 2 * stride);
    hn::StoreU(label3, di, labels + 3 * stride);
  }

  VI zone_vector(int x, int y) const {
    const hn::Rebind<std::uint8_t, DI> d8;
    return hn::PromoteTo(DI(), hn::LoadU(d8, zone_row(x, y)));
  }

  const KernelArguments& arg_;
  const SiteBins& bins_;
  int x0_ = 0, y0_ = 0;
  Candidates tile_;
  Bounds bounds_;
  Limits limits_;
  std::vector<std::pair<int, int>> rows_;  // ranges of the bins' entries
  std::vector<std::int32_t> zone_of_;
  std::vector<int> winners_;
  int winner_count_ = 0;
  ZoneSet zones_, block_zones_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif

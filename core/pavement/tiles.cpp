#include "tessera/pavement/tiles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tessera/pavement/diagram.h"
#include "tessera/pavement/place_vertices.h"
#include "tessera/pavement/seams.h"
#include "tessera/pavement/sites.h"
#include "tessera/pavement/stones.h"
#include "tessera/pavement/whole.h"
#include "tessera/tessellation/match_corners.h"
#include "tessera/tessellation/relax.h"
#include "tessera/tessellation/separate.h"

namespace tessera::pavement {
namespace {

// A site with its place in the order of the whole drawing's.
struct Placed {
  Site site;           // in the drawing's diagram
  std::int64_t order;  // of those sown; of one for an unreached patch that of its first pixel
  bool sown;
  bool operator<(const Placed& other) const { return sown != other.sown ? sown : order < other.order; }
};

bool holds(cv::Rect rect, double x, double y) {
  return x >= rect.x && y >= rect.y && x < rect.br().x && y < rect.br().y;
}

cv::Rect scaled(cv::Rect r, int scale) { return {r.tl() * scale, r.size() * scale}; }

Site shifted(Site site, cv::Point by) {
  site.x += by.x;
  site.y += by.y;
  return site;
}

class Paver {
 public:
  Paver(RowSource& source, const Whole& whole, const Params& params, std::uint64_t seed, Rasterizer& rasterizer,
        const RunContext& context, const TakePart& take)
      : whole_(whole),
        params_(params),
        rasterizer_(rasterizer),
        context_(context),
        take_(take),
        tile_(params.tiles),
        site_halo_(halo_of(kSiteHalo)),
        stone_halo_(halo_of(kStoneHalo)),
        sow_margin_(halo_of(3) + kPartMargin),
        rows_(source, std::max(2 * tile_ + stone_halo_, tile_ + site_halo_) + site_halo_ + kSowStrip + halo_of(16) +
                          4 * kPartMargin),
        sower_(whole.diagram(), params.half_side * whole.scale, params, seed) {}

  // Sites are settled a row of tiles ahead of the stones, which need those around them.
  Result<TilesDone> operator()() {
    if (auto begun = rows_.rewind(); !begun) return tl::unexpected(begun.error());
    const int rows = (whole_.source.height + tile_ - 1) / tile_;
    const int columns = (whole_.source.width + tile_ - 1) / tile_;
    context_.stage("tiles");
    done_.sites = sites_for(whole_.source, params_.half_side);
    for (int row = 0; row <= rows; ++row) {
      if (auto shown = show(row); !shown) return tl::unexpected(shown.error());
      for (int column = 0; row < rows && column < columns; ++column)
        if (auto settled = settle_sites(tile_at(row, column)); !settled) return tl::unexpected(settled.error());
      for (int column = 0; row > 0 && column < columns; ++column)
        if (auto laid = lay(tile_at(row - 1, column)); !laid) return tl::unexpected(laid.error());
      forget(row);
      context_.progress(static_cast<double>(row) / rows);
    }
    return done_;
  }

 private:
  static constexpr int kSowStrip = 64;  // source px

  int halo_of(double half_sides) const { return static_cast<int>(std::ceil(half_sides * params_.half_side)); }

  // In source pixels.
  cv::Rect tile_at(int row, int column) const {
    return cv::Rect(column * tile_, row * tile_, tile_, tile_) & cv::Rect({0, 0}, whole_.source);
  }
  cv::Rect with_halo(cv::Rect tile, int halo) const {
    const cv::Point margin(halo, halo);
    return cv::Rect(tile.tl() - margin, tile.br() + margin) & cv::Rect({0, 0}, whole_.source);
  }

  // Has the rows at hand that settling a row of tiles and laying the one before look at, and sows them.
  Result<void> show(int row) {
    const int begin = std::min((row - 1) * tile_ - stone_halo_, row * tile_ - site_halo_) - kPartMargin;
    const int last = std::min((row + 1) * tile_ + site_halo_, whole_.source.height);
    // A strip is sown once it is at hand with its margin, which lies within what is at hand still.
    while (sower_.next_row() < last * whole_.scale) {
      const int from = sower_.next_row() / whole_.scale;
      const int to = std::min(from + kSowStrip, whole_.source.height);
      const int first = std::max(0, from - sow_margin_);
      const int end = std::min(to + sow_margin_ + 2 * sower_.block() / whole_.scale, whole_.source.height);
      if (auto shown = rows_.show(std::min(begin, first - kPartMargin), end + kPartMargin); !shown) return shown;
      const Fields fields = fields_of_part(rows_, {0, first, whole_.source.width, end - first}, whole_, params_);
      Sites sites;
      sower_.sow(fields, to * whole_.scale, sites);
      for (const Site& site : sites) sown_.push_back({site, count_++, true});
    }
    return rows_.show(begin, last + kPartMargin);
  }

  // Lloyd's iterations with all sites of the tile and its halo; the tile's own are kept.
  Result<void> settle_sites(cv::Rect tile) {
    const Fields fields = fields_of_part(rows_, with_halo(tile, site_halo_), whole_, params_);
    const cv::Rect window({0, 0}, fields.zones.map.size()), own = scaled(tile, whole_.scale) - fields.origin;
    Sites first;
    std::vector<Placed> kept;
    std::vector<std::size_t> index;  // of the kept ones
    for (const Placed& placed : sown_) {
      const Site site = shifted(placed.site, -fields.origin);
      if (!holds(window, site.x, site.y)) continue;
      if (holds(own, site.x, site.y)) {
        kept.push_back(placed);
        index.push_back(first.size());
      }
      first.push_back(site);
    }
    const std::size_t sown = first.size();
    auto relaxed = relax_sites(std::move(first), fields, whole_.noise, params_, rasterizer_, part_context(), {});
    if (!relaxed) return tl::unexpected(relaxed.error());
    done_.reseeded += relaxed->reseeded;
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i].site = shifted(relaxed->sites[index[i]], fields.origin);
    for (std::size_t i = sown; i < relaxed->sites.size(); ++i) {
      const cv::Point patch = relaxed->patches[i - sown];
      if (!holds(own, patch.x, patch.y)) continue;
      const cv::Point p = patch + fields.origin;
      kept.push_back(
          {shifted(relaxed->sites[i], fields.origin), std::int64_t{p.y} * whole_.diagram().width + p.x, false});
    }
    settled_[{tile.y, tile.x}] = std::move(kept);
    return {};
  }

  // The sites that have come out in and around the part, as they follow each other in the whole drawing.
  Sites settled_in(const Fields& fields) const {
    const cv::Rect window(fields.origin, fields.zones.map.size());
    std::vector<Placed> found;
    for (const auto& [tile, sites] : settled_)
      for (const Placed& placed : sites)
        if (holds(window, placed.site.x, placed.site.y)) found.push_back(placed);
    std::sort(found.begin(), found.end());
    Sites sites;
    for (const Placed& placed : found) sites.push_back(shifted(placed.site, -fields.origin));
    return sites;
  }

  // The tile's stones: those of the cells that begin in it.
  Result<void> lay(cv::Rect tile) {
    const Fields fields = fields_of_part(rows_, with_halo(tile, stone_halo_), whole_, params_);
    Sites sites = settled_in(fields);
    LabelMap labels;
    if (auto begun = rasterizer_.begin(fields.zones.map, Metric::kFrustum, reach_of(fields)); !begun) return begun;
    if (auto labelled = rasterizer_.label(sites, labels); !labelled) return labelled;
    const Diagram diagram = diagram_of(std::move(sites), std::move(labels), fields);
    const std::vector<cv::Point> names = first_pixels(diagram, fields.origin);

    const Tessellation placed = place_vertices(diagram, fields);
    std::vector<char> matched = match_corners(placed);
    const std::vector<Pin> pins = seams_.adopt(names, fields.origin, placed, matched);
    Tessellation laid = placed;
    std::vector<char> flat = matched;
    relax(
        laid, flat, [&](int vertex, Point p) { return back_to_frontier(laid, fields, vertex, p); },
        {.origin = fields.origin}, pins);
    if (auto go_on = context_.check(); !go_on) return go_on;

    const cv::Rect own = scaled(tile, whole_.scale);
    std::vector<Ring> rings = separate_pieces(laid, flat, params_.wide_angle);
    std::vector<int> vertices_before;
    for (int cell = 0; cell < diagram.cells; ++cell) {
      vertices_before.push_back(laid.map.corners(cell));
      if (!own.contains(names[cell])) {
        rings[cell].clear();
      } else if (near_border(own, names[cell])) {
        seams_.keep(names[cell], placed, laid, matched, cell, fields.origin);
      }
    }
    Output part;
    part.first_id = next_id_;
    part.sheet = empty_sheet(whole_.source, params_);
    lay_stones(std::move(rings), vertices_before, diagram, fields, params_, part);
    next_id_ += static_cast<int>(part.sheet.pieces.size());
    ++done_.tiles;
    return take_(std::move(part));
  }

  // Whether tiles beside this one look at a cell that begins there.
  bool near_border(cv::Rect own, cv::Point p) const {
    const int halo = 3 * stone_halo_ * whole_.scale / 2;
    return p.x < own.x + halo || p.x >= own.br().x - halo || p.y >= own.br().y - halo;
  }

  // What no row of tiles below will look at.
  void forget(int row) {
    const int top = ((row + 1) * tile_ - site_halo_) * whole_.scale;
    std::erase_if(sown_, [&](const Placed& placed) { return placed.site.y < top; });
    settled_.erase(settled_.begin(), settled_.lower_bound({(row - 1) * tile_, 0}));
    seams_.forget_above((row * tile_ - 2 * stone_halo_) * whole_.scale);
  }

  RunContext part_context() const {
    RunContext context;
    context.stop = context_.stop;
    return context;
  }

  const Whole& whole_;
  const Params& params_;
  Rasterizer& rasterizer_;
  const RunContext& context_;
  const TakePart& take_;
  int tile_, site_halo_, stone_halo_, sow_margin_;  // source px
  RowWindow rows_;
  Sower sower_;
  std::int64_t count_ = 0;                                      // of sown sites
  std::vector<Placed> sown_;                                    // first sites of the rows at hand
  std::map<std::pair<int, int>, std::vector<Placed>> settled_;  // of each tile, by its (y, x)
  Seams seams_;
  int next_id_ = 1;
  TilesDone done_;
};

}  // namespace

Result<TilesDone> run_tiles(RowSource& source, const Params& requested, std::uint64_t seed, Rasterizer& rasterizer,
                            const RunContext& context, const TakePart& take) {
  Params params = requested;
  params.half_side = half_side_of(source.size(), requested);
  // Where the number of sites says how large they are.
  params.tiles = std::max(requested.tiles, static_cast<int>(std::ceil(kLeastTile * params.half_side)));
  context.stage("fields");
  const auto whole = look_through(source, params, seed, context);
  if (!whole) return tl::unexpected(whole.error());
  return Paver(source, *whole, params, seed, rasterizer, context, take)();
}

}  // namespace tessera::pavement

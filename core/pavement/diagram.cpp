#include "tessera/pavement/diagram.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/base/portable_math.h"
#include "tessera/voronoi/cells.h"

namespace tessera::pavement {
namespace {

// The direction across a thin line: along which the distance field falls off fastest to both sides.
double angle_across(const DistanceField& field, double x, double y, double step) {
  const auto d = [&](double dx, double dy) -> double { return at(field, x + dx * step, y + dy * step); };
  const double centre = d(0, 0);
  const double xx = d(1, 0) + d(-1, 0) - 2 * centre, yy = d(0, 1) + d(0, -1) - 2 * centre;
  const double xy = (d(1, 1) + d(-1, -1) - d(1, -1) - d(-1, 1)) / 4;
  return atan2_portable(2 * xy, xx - yy) / 2 + kPi / 2;
}

class Lloyd {
 public:
  Lloyd(const Fields& fields, const NoiseDirection& noise, const Params& params)
      : fields_(fields), noise_(noise), params_(params) {}

  // Turns a site, and near an edge moves it to lie in the row of stones along that edge.
  void settle(Site& site) const {
    const double h = fields_.half_side;
    // The nearest pixel tells far from near; only near ones need the distance itself.
    const double roughly = fields_.distance_near(site.x, site.y);
    const double distance = roughly > 1.5 * h + 1 ? roughly : at(fields_.distance, site.x, site.y);
    const double half_width = distance < kSingleRow * h ? fields_.half_width_at(site.x, site.y, 2 * h) : 2 * h;
    if (half_width < kSingleRow * h) {
      settle_in_band(site, distance, half_width);
    } else if (distance >= 1.5 * h || !settle_at_edge(site, distance, std::min(h, half_width / 2))) {
      site.angle = noise_.angle(site.x + fields_.origin.x, site.y + fields_.origin.y);
    }
    site.x = std::clamp(snap_position(site.x), 0.0, static_cast<double>(fields_.zones.map.cols));
    site.y = std::clamp(snap_position(site.y), 0.0, static_cast<double>(fields_.zones.map.rows));
    site.angle = snap_angle(site.angle);
  }

  // A cell's centre of mass is its new site, unless it lies in another zone.
  void recentre(Site& site, const CellMoments& moments) const {
    const double x = moments.centroid_x(), y = moments.centroid_y();
    if (fields_.zone_at(x, y) == site.zone) {
      site.x = x;
      site.y = y;
    }
    settle(site);
  }

  // Asks for the pixels that a site will look at in a while: it does not move far.
  void prefetch(const Site& site) const { fields_.prefetch(site.x, site.y); }

 private:
  // A band too narrow for two rows of stones gets one, whose stones reach across.
  void settle_in_band(Site& site, double distance, double half_width) const {
    if (distance < 0.75 * half_width) move_uphill(site, half_width - distance);
    site.angle = angle_across(fields_.distance, site.x, site.y, std::max(1.0, std::ceil(0.7 * half_width)));
    site.extent_u = static_cast<float>(params_.cap_scale * half_width);
    site.extent_v = static_cast<float>(params_.cap_scale * half_length(half_width, fields_.half_side));
  }

  // III.B: nearer than 1.5 h to an edge, a site moves to distance h and turns with the edge (Eq. 3).
  bool settle_at_edge(Site& site, double distance, double wanted) const {
    const cv::Vec2d up = move_uphill(site, wanted - distance);
    if (up[0] == 0 && up[1] == 0) return false;
    site.angle = atan2_portable(up[1], up[0]);
    return true;
  }

  // Moves a site away from the edge by `way`, unless that leaves its zone; the direction of away.
  cv::Vec2d move_uphill(Site& site, double way) const {
    const int step = std::max(1, static_cast<int>(std::lround(fields_.half_side / 2)));
    const cv::Vec2d up = uphill(fields_.distance, site.x, site.y, step);
    const double x = site.x + way * up[0], y = site.y + way * up[1];
    if (fields_.zone_at(x, y) == site.zone) {
      site.x = x;
      site.y = y;
    }
    return up;
  }

  static constexpr double kSingleRow = 1.5;  // of h: half the width of the widest band with one row

  const Fields& fields_;
  const NoiseDirection& noise_;
  const Params& params_;
};

// Sites for the patches that no site reached: each becomes a cell of its own. The patches' first pixels.
std::vector<cv::Point> seed_unreached(Sites& sites, const LabelMap& labels, const Fields& fields,
                                      const Params& params) {
  const int first = static_cast<int>(sites.size());
  int cells = first;
  const CellRuns runs = connected_runs(labels, fields.zones.map, cells);
  std::vector<cv::Point> deepest(cells - first, {-1, -1}), begins(cells - first, {-1, -1});
  for (const int i : runs.changed) {
    const CellRun& run = runs.all[i];
    if (run.label < first) continue;
    cv::Point &best = deepest[run.label - first], &begin = begins[run.label - first];
    if (begin.x < 0 || run.y < begin.y || (run.y == begin.y && run.begin < begin.x)) begin = {run.begin, run.y};
    for (int x = run.begin; x < run.end; ++x)
      if (best.x < 0 || fields.distance(run.y, x) > fields.distance(best)) best = {x, run.y};
  }
  for (const cv::Point& p : deepest) {
    Site site;
    site.x = p.x + 0.5;
    site.y = p.y + 0.5;
    site.zone = fields.zones.map(p);
    site.extent_u = site.extent_v = static_cast<float>(params.cap_scale * fields.half_side);
    sites.push_back(site);
  }
  return begins;
}

// A cell's zone, from any of its pixels.
std::vector<std::uint8_t> zones_of_cells(const LabelMap& labels, const cv::Mat1b& zones, int cells) {
  std::vector<std::uint8_t> zone(cells, 0);
  for (int y = 0; y < labels.rows; ++y) {
    const int* row = labels[y];
    for (int x = 0; x < labels.cols; ++x)
      if (x == 0 || row[x] != row[x - 1]) zone[row[x]] = zones(y, x);
  }
  return zone;
}

}  // namespace

double reach_of(const Fields& fields) { return 8 * fields.half_side; }

Result<Relaxed> relax_sites(Sites first, const Fields& fields, const NoiseDirection& noise, const Params& params,
                            Rasterizer& rasterizer, const RunContext& context, const IterationObserver& observer) {
  constexpr int kAhead = 12;  // sites
  const Lloyd lloyd(fields, noise, params);
  CellSums sums;
  Relaxed relaxed{std::move(first), {}, {}, 0};
  auto& [sites, labels, patches, reseeded] = relaxed;
  if (auto ready = rasterizer.begin(fields.zones.map, Metric::kFrustum, reach_of(fields)); !ready)
    return tl::unexpected(ready.error());
  cv::parallel_for_({0, static_cast<int>(sites.size())}, [&, &sites = sites](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) lloyd.settle(sites[i]);
  });

  for (int iteration = 0; iteration <= params.iterations; ++iteration) {
    if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
    if (auto labelled = rasterizer.label(sites, labels); !labelled) return tl::unexpected(labelled.error());
    if (iteration == 0) {
      const std::size_t reached = sites.size();
      patches = seed_unreached(sites, labels, fields, params);
      for (std::size_t i = reached; i < sites.size(); ++i) lloyd.settle(sites[i]);
      if (sites.size() > reached)
        if (auto again = rasterizer.label(sites, labels); !again) return tl::unexpected(again.error());
    }
    if (observer) observer({iteration, params.iterations, fields.scale, sites, labels, fields.zones.palette});
    context.progress(0.1 + 0.6 * (iteration + 1) / (params.iterations + 1));
    if (iteration == params.iterations) break;
    const std::vector<CellMoments>& moments = sums.of(labels, static_cast<int>(sites.size()));
    cv::parallel_for_({0, static_cast<int>(sites.size())}, [&, &sites = sites](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i) {
        lloyd.prefetch(sites[std::min(i + kAhead, range.end - 1)]);
        if (moments[i].count > 0) lloyd.recentre(sites[i], moments[i]);
      }
    });
    reseeded += reseed_empty_near(sites, moments, reach_of(fields));
  }
  return relaxed;
}

Diagram diagram_of(Sites sites, LabelMap labels, const Fields& fields) {
  Diagram diagram;
  diagram.labels = std::move(labels);
  diagram.cells = connect_cells(diagram.labels, fields.zones.map, static_cast<int>(sites.size()));
  diagram.graph = open_enclosures(diagram.labels, fields.zones.map, diagram.cells);
  diagram.cell_zone = zones_of_cells(diagram.labels, fields.zones.map, diagram.cells);
  diagram.sites = std::move(sites);
  return diagram;
}

}  // namespace tessera::pavement

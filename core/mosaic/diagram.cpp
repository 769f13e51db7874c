#include "tessera/mosaic/diagram.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <utility>

#include "tessera/base/portable_math.h"
#include "tessera/mosaic/sites.h"
#include "tessera/mosaic/torus.h"
#include "tessera/voronoi/cells.h"

namespace tessera::mosaic {
namespace {

constexpr double kReach = 12;  // in half sides of a tile

class Lloyd {
 public:
  Lloyd(const Fields& fields, const Params& params) : fields_(fields), params_(params) {}

  // Moves a site to `p`, then into the first row along an edge if it is near one.
  void settle(Site& site, Point p) const {
    p = fields_.inside(p);
    if (params_.style == Style::kVermiculatum) p = into_first_row(p);
    site.x = std::clamp(snap_position(p.x), 0.0, static_cast<double>(fields_.size.width));
    site.y = std::clamp(snap_position(p.y), 0.0, static_cast<double>(fields_.size.height));
    bring_home(site, fields_.torus);
    turn_and_size(site, fields_, params_);
  }

 private:
  // As stones in a pavement: what is nearer to an edge than one side lies half a tile away from it.
  Point into_first_row(Point p) const {
    const double across = fields_.side(p.x, p.y) / std::sqrt(params_.aspect);
    const double distance = at(fields_.distance, p.x, p.y);
    if (distance >= kFirstRow * across) return p;
    const Point q = p + (0.5 * across - distance) * fields_.uphill(p);
    return q == fields_.inside(q) ? q : p;
  }

  static constexpr double kFirstRow = 0.8;  // of a tile's side

  const Fields& fields_;
  const Params& params_;
};

// 6: the edges as thick lines, `width` of a tile's side.
cv::Mat1b thick_edges(const Fields& fields, double width) {
  cv::Mat1b lines = cv::Mat1b::zeros(fields.size);
  float widest = 0;
  for (const float v : fields.sides) widest = std::max(widest, v);
  for (int y = 0; y < lines.rows; ++y)
    for (int x = 0; x < lines.cols; ++x) {
      const float distance = fields.distance(y, x);
      if (distance <= 0.5 * width * widest && distance <= 0.5 * width * fields.side(x, y)) lines(y, x) = 255;
    }
  return lines;
}

// Draws diagrams of sites, on a torus with their ghosts around them.
class Drawer {
 public:
  Drawer(const Torus& torus, Rasterizer& rasterizer) : torus_(torus), rasterizer_(rasterizer) {}

  // `sites` end without ghosts, unless they shall stay.
  Result<void> draw(Sites& sites, LabelMap& labels, bool keeps_ghosts = false) {
    if (!torus_.wraps()) return rasterizer_.label(sites, labels);
    const std::size_t own = sites.size();
    ghosts_.emplace(torus_, sites);
    auto labelled = rasterizer_.label(sites, labels);
    if (labelled) ghosts_->wrap(labels);
    if (!keeps_ghosts) sites.resize(own);
    return labelled;
  }

  // How many labels the last diagram of `sites` may hold.
  int labels_of(const Sites& sites) const {
    return static_cast<int>(sites.size()) + (ghosts_ ? ghosts_->count() : 0);
  }

  void show(const IterationObserver& observer, int index, int last, const Sites& sites,
            const LabelMap& labels) const {
    static const std::vector<Rgb> palette = {{200, 196, 188}};
    if (!observer) return;
    if (!torus_.wraps()) return observer({index, last, 1, sites, labels, palette});
    Sites within = sites;
    for (Site& site : within) site.x -= torus_.margin, site.y -= torus_.margin;
    observer({index, last, 1, within, ghosts_->window_of(labels), palette});
  }

 private:
  const Torus& torus_;
  Rasterizer& rasterizer_;
  std::optional<Ghosts> ghosts_;
};

// Cells in one piece each, of sites with their ghosts.
Result<void> finish(Diagram& diagram, Drawer& drawer, const Torus& torus, const cv::Mat1b& plain) {
  diagram.own = static_cast<int>(diagram.sites.size());
  if (torus.wraps()) {
    if (auto drawn = drawer.draw(diagram.sites, diagram.labels, true); !drawn) return drawn;
  }
  diagram.cells = connect_cells(diagram.labels, plain, static_cast<int>(diagram.sites.size()));
  diagram.graph = open_enclosures(diagram.labels, plain, diagram.cells);
  return {};
}

}  // namespace

Result<Diagram> relax_diagram(Sites sites, const Fields& fields, const Params& params, Rasterizer& rasterizer,
                              const RunContext& context, const IterationObserver& observer) {
  const Lloyd lloyd(fields, params);
  const cv::Mat1b plain = cv::Mat1b::zeros(fields.size);
  CellSums sums;
  Drawer drawer(fields.torus, rasterizer);
  Diagram diagram;
  const bool avoids = params.avoidance > 0 && params.iterations > params.settle && cv::countNonZero(fields.edges) > 0;
  const int avoiding = avoids ? params.iterations - params.settle : 0;
  const cv::Mat1b lines = avoids ? thick_edges(fields, params.avoidance) : cv::Mat1b();
  if (auto ready = rasterizer.begin(plain, Metric::kChebyshev, kReach); !ready) return tl::unexpected(ready.error());

  for (int iteration = 0; iteration <= params.iterations; ++iteration) {
    if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
    if (auto drawn = drawer.draw(sites, diagram.labels); !drawn) return tl::unexpected(drawn.error());
    drawer.show(observer, iteration, params.iterations, sites, diagram.labels);
    context.progress(0.15 + 0.6 * (iteration + 1) / (params.iterations + 1));
    if (iteration == params.iterations) break;
    if (iteration < avoiding) diagram.labels.setTo(kUnlabelled, lines);
    const std::vector<CellMoments>& moments = sums.of(diagram.labels, drawer.labels_of(sites));
    std::vector<double> moved(sites.size(), 0);
    cv::parallel_for_({0, static_cast<int>(sites.size())}, [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i) {
        if (moments[i].count == 0) continue;
        const Point before{sites[i].x, sites[i].y};
        lloyd.settle(sites[i], {moments[i].centroid_x(), moments[i].centroid_y()});
        moved[i] = length(Point{sites[i].x, sites[i].y} - before);
      }
    });
    diagram.reseeded += reseed_empty(sites, moments);
    for (Site& site : sites) bring_home(site, fields.torus);
    diagram.iterations = iteration + 1;
    double sum = 0;
    for (const double way : moved) sum += way;
    if (iteration >= avoiding && sum < params.tolerance * static_cast<double>(sites.size())) {
      if (auto drawn = drawer.draw(sites, diagram.labels); !drawn) return tl::unexpected(drawn.error());
      break;
    }
  }

  diagram.sites = std::move(sites);
  if (auto finished = finish(diagram, drawer, fields.torus, plain); !finished)
    return tl::unexpected(finished.error());
  return diagram;
}

}  // namespace tessera::mosaic

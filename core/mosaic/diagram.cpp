#include "tessera/mosaic/diagram.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/base/portable_math.h"
#include "tessera/mosaic/sites.h"
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

}  // namespace

Result<Diagram> relax_diagram(Sites sites, const Fields& fields, const Params& params, Rasterizer& rasterizer,
                              const RunContext& context, const IterationObserver& observer) {
  const Lloyd lloyd(fields, params);
  const cv::Mat1b plain = cv::Mat1b::zeros(fields.size);
  const std::vector<Rgb> palette = {{200, 196, 188}};
  CellSums sums;
  Diagram diagram;
  const bool avoids = params.avoidance > 0 && params.iterations > params.settle && cv::countNonZero(fields.edges) > 0;
  const int avoiding = avoids ? params.iterations - params.settle : 0;
  const cv::Mat1b lines = avoids ? thick_edges(fields, params.avoidance) : cv::Mat1b();
  if (auto ready = rasterizer.begin(plain, Metric::kChebyshev, kReach); !ready) return tl::unexpected(ready.error());

  for (int iteration = 0; iteration <= params.iterations; ++iteration) {
    if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
    if (auto labelled = rasterizer.label(sites, diagram.labels); !labelled) return tl::unexpected(labelled.error());
    if (observer) observer({iteration, params.iterations, 1, sites, diagram.labels, palette});
    context.progress(0.15 + 0.6 * (iteration + 1) / (params.iterations + 1));
    if (iteration == params.iterations) break;
    if (iteration < avoiding) diagram.labels.setTo(kUnlabelled, lines);
    const std::vector<CellMoments>& moments = sums.of(diagram.labels, static_cast<int>(sites.size()));
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
    diagram.iterations = iteration + 1;
    double sum = 0;
    for (const double way : moved) sum += way;
    if (iteration >= avoiding && sum < params.tolerance * static_cast<double>(sites.size())) {
      if (auto labelled = rasterizer.label(sites, diagram.labels); !labelled) return tl::unexpected(labelled.error());
      break;
    }
  }

  diagram.cells = connect_cells(diagram.labels, plain, static_cast<int>(sites.size()));
  diagram.graph = open_enclosures(diagram.labels, plain, diagram.cells);
  diagram.sites = std::move(sites);
  return diagram;
}

}  // namespace tessera::mosaic

#include "tessera/pavement/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/pavement/diagram.h"
#include "tessera/pavement/fields.h"
#include "tessera/pavement/paper_stones.h"
#include "tessera/pavement/place_vertices.h"
#include "tessera/pavement/sites.h"
#include "tessera/pavement/stones.h"
#include "tessera/tessellation/match_corners.h"
#include "tessera/tessellation/relax.h"
#include "tessera/tessellation/separate.h"

namespace tessera::pavement {
namespace {

// Diagrams that take all the memory there is are slips.
constexpr double kMostPixels = 4e8, kMostSites = 1 << 22;

Result<void> check_size(const ImageView& drawing, const Params& params) {
  const double pixels = static_cast<double>(drawing.width) * drawing.height, scale = std::max(1, params.supersample);
  if (pixels * scale * scale > kMostPixels)
    return fail(StatusCode::kInvalidParameter, "supersample",
                fmt::format("makes a diagram of {:.0f} Mpx, expected at most {:.0f}", pixels * scale * scale / 1e6,
                            kMostPixels / 1e6));
  const double sites = pixels / (4 * params.half_side * params.half_side);  // Eq. 1
  if (std::floor(sites) > kMostSites)
    return fail(StatusCode::kInvalidParameter, "halfSide",
                fmt::format("makes about {:.0f} stones, expected at most {:.0f}", sites, kMostSites));
  return {};
}

// Cells to polygons (III.C): rings in pixels of the diagram, one a cell.
std::vector<Ring> extract_stones(const Diagram& diagram, const Fields& fields, const Params& params,
                                 std::vector<int>& vertices_before) {
  if (params.method == Method::kPaper) {
    PaperStones stones = paper_stones(diagram, fields, params);
    vertices_before = std::move(stones.vertices_before);
    return std::move(stones.rings);
  }
  Tessellation tessellation = place_vertices(diagram, fields);
  for (int cell = 0; cell < tessellation.cells(); ++cell) vertices_before.push_back(tessellation.map.corners(cell));
  std::vector<char> flat = match_corners(tessellation);
  relax(tessellation, flat, [&](int vertex, Point p) { return back_to_frontier(tessellation, fields, vertex, p); });
  return separate_pieces(tessellation, flat, params.wide_angle);
}

}  // namespace

Result<Output> run(const ImageView& drawing, const Params& requested, std::uint64_t seed, Rasterizer& rasterizer,
                   const RunContext& context, const IterationObserver& observer) {
  if (drawing.width < 1 || drawing.height < 1)
    return fail(StatusCode::kInvalidInput, "drawing", "has no pixels; expected at least 1 x 1");

  Params params = requested;
  params.half_side = half_side_of({drawing.width, drawing.height}, requested);
  if (auto good = check_size(drawing, params); !good) return tl::unexpected(good.error());

  context.stage("fields");
  const Fields fields = make_fields(drawing, params);
  context.progress(0.08);

  context.stage("diagram");
  Output output;
  output.sites = sites_for({drawing.width, drawing.height}, params.half_side);
  Result<Relaxed> relaxed = relax_sites(first_sites(fields, params, seed), fields, noise_of(fields, params, seed),
                                        params, rasterizer, context, observer);
  if (!relaxed) return tl::unexpected(relaxed.error());
  output.reseeded = relaxed->reseeded;
  const Diagram diagram = diagram_of(std::move(relaxed->sites), std::move(relaxed->labels), fields);

  context.stage("stones");
  std::vector<int> vertices_before;
  std::vector<Ring> rings = extract_stones(diagram, fields, params, vertices_before);
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  output.sheet = empty_sheet({drawing.width, drawing.height}, params);
  lay_stones(std::move(rings), vertices_before, diagram, fields, params, output);
  context.progress(1);
  return output;
}

}  // namespace tessera::pavement

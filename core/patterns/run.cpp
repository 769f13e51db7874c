#include "tessera/patterns/run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/base/portable_math.h"
#include "tessera/patterns/bombs.h"
#include "tessera/patterns/driving_points.h"
#include "tessera/patterns/johnson_mehl.h"
#include "tessera/patterns/lattice_cells.h"
#include "tessera/patterns/line_cells.h"
#include "tessera/patterns/pixel_noise.h"
#include "tessera/patterns/shrink.h"
#include "tessera/patterns/voronoi_cells.h"

namespace tessera::patterns {
namespace {

constexpr double kMostPieces = 2e7;
constexpr double kChordShare = 1e-3;  // of a cell's size, from a Johnson-Mehl cell's border to its chords

struct Colours {
  ColourModel model;
  Levels border;
};
Colours colours_of(const Params& p) {
  Colours colours;
  read_colours(texts_of(p), colours.model, colours.border);
  return colours;
}

// The cells of a structure (section 3), uncoloured.
Result<Cells> tessellate(const ImageView& density, const Params& p, const Window& window, Rng& rng,
                         const RunContext& context) {
  const double intensity = driving_intensity(p);
  const auto points = [&](double reach) { return driving_points(density, p, window, reach, rng); };
  switch (p.model) {
    case Model::kPoissonLines:
      return line_cells(
          window.periodic ? closed_lines(window, intensity, rng) : poisson_lines(window, intensity, rng), window);
    case Model::kJohnsonMehl: {
      const double rate = intensity / p.speed;
      const std::vector<Nucleus> nuclei = grow_nuclei(window, rate, rng);
      context.progress(0.3);
      return johnson_mehl_cells(nuclei, window, rate, kChordShare / std::cbrt(rate), context);
    }
    case Model::kDelaunay: return delaunay_cells(points(2 * reach_of_cells(p)), window, reach_of_cells(p));
    case Model::kCheckerboard: return lattice_cells(Lattice::kSquares, p.size, window, rng);
    case Model::kHexagon: return lattice_cells(Lattice::kHexagons, p.size, window, rng);
    case Model::kTriangle: return lattice_cells(Lattice::kTriangles, p.size, window, rng);
    case Model::kGaussian: return pixel_cells(window);
    case Model::kPoints: return draw_points(points(0), p.dot);
    case Model::kOccupancy: return voronoi_cells(points(reach_of_cells(p)), window, reach_of_cells(p));
    default: return drop_bombs(points(bomb_reach(p)), p, rng);  // section 4
  }
}

bool has_borders(const Params& p) {
  return p.border > 0 && !is_bombing(p.model) && p.model != Model::kPoints && p.model != Model::kGaussian;
}

// Half a border's thickness inwards on every side; colours follow their cells. The cells are those of a wider window,
// so that there is no border along the window's own sides.
Cells with_borders(const Cells& cells, std::vector<Levels>& colours, const Params& p, const Window& window) {
  Cells inner;
  std::vector<Levels> theirs;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Ring ring = shrink(cells[i], p.border / 2);
    if (ring.empty()) continue;
    if (window.periodic)
      inner.push_back(std::move(ring));
    else
      append_within(window, std::move(ring), inner);
    theirs.resize(inner.size(), colours[i]);
  }
  colours = std::move(theirs);
  return inner;
}

// One of the colours each, by itself (section 3, step 2); bombs and points have the first.
std::vector<Levels> colour(const Cells& cells, const Params& p, const Window& window, std::uint64_t seed) {
  const ColourModel model = colours_of(p).model;
  Rng rng(seed, RngPurpose::kColours);
  if (p.model == Model::kGaussian) return pixel_colours(model, p.correlation, window, rng);
  const bool alike = is_bombing(p.model) || p.model == Model::kPoints;
  std::vector<Levels> colours;
  colours.reserve(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ColourClass& its = alike ? model.classes[0] : draw_class(model, rng);
    colours.push_back(p.variation == Variation::kCell ? draw_colour(its, its.mean, model.channels, rng) : its.mean);
  }
  return colours;
}

PieceSheet empty_sheet(const Params& p) {
  PieceSheet sheet;
  sheet.kind = is_bombing(p.model) ? "bomb" : p.model == Model::kPoints ? "point" : "cell";
  sheet.layer = sheet.kind + "s";
  sheet.points = p.model == Model::kPoints;
  sheet.width = p.width;
  sheet.height = p.height;
  sheet.width_mm = p.width_mm;
  sheet.seamless = p.seamless;
  const Colours colours = colours_of(p);
  const std::vector<ColourClass>& classes = colours.model.classes;
  const bool on_ground = is_bombing(p.model) || p.model == Model::kPoints;
  const Levels& between = on_ground && classes.size() > 1 ? classes[1].mean : colours.border;
  sheet.channels = p.channels;
  sheet.grout = fill_of(between, p.channels);
  sheet.grout_opacity = opacity_of(between, p.channels);
  return sheet;
}

}  // namespace

Result<Output> run(const ImageView& density, const Params& params, std::uint64_t seed, const RunContext& context) {
  if (expected_pieces(params) > kMostPieces)
    return fail(StatusCode::kInvalidParameter, params.intensity < 0 ? "size" : "intensity",
                "makes more than 20 million pieces in this window, expected fewer");

  context.stage("cells");
  const Window window{{0, 0}, {params.width, params.height}, params.seamless};
  // By the same for any thin border, so that another one leaves the pattern as it is.
  const double margin = std::max(params.border, params.size);
  const Window wider = has_borders(params) && !params.seamless ? window.grown(margin) : window;
  Rng rng(seed, RngPurpose::kSites);
  auto cells = tessellate(density, params, wider, rng, context);
  if (!cells) return tl::unexpected<Status>(std::move(cells.error()));
  if (cells->empty()) context.warn("the pattern is empty: its process has made nothing in this window");
  if (auto go_on = context.check(); !go_on) return tl::unexpected<Status>(std::move(go_on.error()));
  context.progress(0.8);

  context.stage("colours");
  std::vector<Levels> colours = colour(*cells, params, window, seed);
  if (has_borders(params)) *cells = with_borders(*cells, colours, params, window);

  Output output{empty_sheet(params), {}, driving_intensity(params)};
  output.sheet.pieces.reserve(cells->size());
  output.areas.reserve(cells->size());
  for (std::size_t i = 0; i < cells->size(); ++i) {
    output.areas.push_back(std::abs(signed_area((*cells)[i])));
    output.sheet.pieces.push_back({static_cast<int>(i) + 1,
                                   {std::move((*cells)[i]), {}},
                                   fill_of(colours[i], params.channels),
                                   opacity_of(colours[i], params.channels)});
  }
  context.progress(1);
  return output;
}

bool has_finish(const Params& p) { return p.filter > 1 || p.variation == Variation::kWithin; }

void finish(Raster& picture, const Params& p, std::uint64_t seed) {
  if (p.variation == Variation::kWithin && p.model != Model::kGaussian) add_noise(picture, colours_of(p).model, seed);
  mean_filter(picture, p.filter, p.seamless);
}

}  // namespace tessera::patterns

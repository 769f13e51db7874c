#include "tessera/mosaic/run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "tessera/mosaic/colours.h"
#include "tessera/mosaic/diagram.h"
#include "tessera/mosaic/measures.h"
#include "tessera/mosaic/sites.h"
#include "tessera/mosaic/tiles.h"

namespace tessera::mosaic {
namespace {

constexpr double kLeastArea = 0.05;  // px^2: what is left of a tile that is none
constexpr double kMeetingSides = 2;  // of a tile: how far colours of a seamless mosaic's sides reach into each other
constexpr double kPixelsPerTile = 6.5;  // no tile is smaller on average

double pixels_of(const ImageView& photo) { return static_cast<double>(photo.width) * photo.height; }

// As many tiles as asked for, or as the picture has room for.
int possible_tiles(const ImageView& photo, int tiles) {
  return static_cast<int>(std::min<double>(tiles, std::max(1.0, pixels_of(photo) / kPixelsPerTile)));
}

// Colour and a place on the sheet; cells that are no tiles are left out.
void lay_tiles(std::vector<Ring> rings, const ImageView& photo, const Params& params, Output& output) {
  std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3 || std::fabs(signed_area(ring)) < kLeastArea; });
  std::vector<Rgb> colours = tile_colours(photo, rings, params.sample);
  output.sheet.materials = limit_colours(params.palette, colours);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    output.areas.push_back(std::fabs(signed_area(rings[i])));
    output.sheet.pieces.push_back({static_cast<int>(i) + 1, {std::move(rings[i]), {}}, colours[i]});
  }
}

// The photo along its left and right sides blended, within `reach` px, into what the opposite one mirrors: half and
// half at the side itself, so that both are alike there.
cv::Mat3b sides_met(const cv::Mat3b& photo, double reach) {
  cv::Mat3b met(photo.size());
  for (int x = 0; x < photo.cols; ++x) {
    const double away = std::min(x, photo.cols - 1 - x) + 0.5, own = std::min(1.0, 0.5 + 0.5 * away / reach);
    for (int y = 0; y < photo.rows; ++y)
      for (int c = 0; c < 3; ++c)
        met(y, x)[c] = static_cast<std::uint8_t>(
            std::lround(own * photo(y, x)[c] + (1 - own) * photo(y, photo.cols - 1 - x)[c]));
  }
  return met;
}

// The colours of the canvas: a torus' sides meet in the same ones.
cv::Mat3b colours_of(const cv::Mat3b& photo, const Torus& torus, double side) {
  if (!torus.wraps()) return photo;
  const double reach = kMeetingSides * side;
  const cv::Mat3b turned = sides_met(photo, reach).t();
  return torus.repeated<cv::Vec3b>(sides_met(turned, reach).t());
}

// From the canvas to the window of a seamless mosaic.
void shift(PieceSheet& sheet, int by) {
  if (by == 0) return;
  for (Piece& piece : sheet.pieces)
    for (Point& p : piece.outline.outer) p += Point{static_cast<double>(by), static_cast<double>(by)};
}

}  // namespace

Result<Output> run(const Pictures& pictures, const Params& requested, std::uint64_t seed, Rasterizer& rasterizer,
                   const RunContext& context, const IterationObserver& observer) {
  const ImageView& photo = pictures.photo;
  if (photo.width < 1 || photo.height < 1)
    return fail(StatusCode::kInvalidInput, "photo", "has no pixels; expected at least 1 x 1");

  Params params = requested;
  params.tiles = possible_tiles(photo, requested.tiles);

  context.stage("fields");
  const double side = std::sqrt(pixels_of(photo) / params.tiles);  // 5.2
  Fields fields = make_fields(pictures, params, side, &rasterizer);
  context.progress(0.08);

  context.stage("sites");
  Sites sites = params.style == Style::kHausner ? random_sites(fields, params, seed) : rows_of_sites(fields, params);
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  context.progress(0.15);

  context.stage("diagram");
  Result<Diagram> diagram = relax_diagram(std::move(sites), fields, params, rasterizer, context, observer);
  if (!diagram) return tl::unexpected(diagram.error());

  context.stage("tiles");
  std::vector<Ring> rings = shape_tiles(*diagram, fields, params);
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  context.progress(0.9);

  Output output;
  output.iterations = diagram->iterations;
  output.reseeded = diagram->reseeded;
  output.sheet.kind = "tile";
  output.sheet.layer = "tiles";
  output.sheet.width = photo.width;
  output.sheet.height = photo.height;
  output.sheet.width_mm = params.width_mm;
  output.sheet.grout = {150, 146, 138};
  const cv::Mat3b canvas = colours_of(photo.mat(), fields.torus, side);
  lay_tiles(std::move(rings), {canvas.data, canvas.cols, canvas.rows, static_cast<std::ptrdiff_t>(canvas.step)},
            params, output);
  measure_tiles(fields, output);
  output.sheet.seamless = params.seamless;
  shift(output.sheet, -fields.torus.margin);
  context.progress(1);
  return output;
}

}  // namespace tessera::mosaic

// Parameters of the mosaic technique; symbols and sections are those of "Simulating Decorative Mosaics" (Hausner
// 2001).
#pragma once

#include <string>

#include "tessera/base/parameter.h"
#include "tessera/mosaic/regions.h"
#include "tessera/mosaic/tile_palette.h"

namespace tessera::mosaic {

enum class Style { kVermiculatum, kHausner };
enum class Shape { kQuad, kSquare, kRectangle, kTrapezoid, kMoment, kEllipse, kCell };
enum class SizesBy { kDetail, kSaliency };
enum class Sample { kMean, kPoint };

struct Params {
  int tiles = 2000;
  double variation = 2;
  SizesBy sizes_by = SizesBy::kDetail;
  double grout = 1;
  std::string palette;
  Style style = Style::kVermiculatum;
  Shape shape = Shape::kQuad;
  double aspect = 1;
  double delta = 0.8;
  bool clip = true;
  bool chips = false;
  bool seamless = false;
  int iterations = 20;
  double tolerance = 0;
  double avoidance = 0.25;
  int settle = 4;
  double edge_share = 0.04;
  double edge_detail = 0.35;
  double smoothing = 8;
  std::string region_sizes = "#0000ff=1.6 #00ff00=1 #ff00ff=0.5";
  Sample sample = Sample::kMean;
  double width_mm = 0;
};

// clang-format off: a parameter is read as a line or two, not as a column
template <class Visitor>
void visit(Visitor& v, Params& p) {
  v.integer(p.tiles, {.key = "tiles",
                      .min = 1,
                      .max = 4194304,
                      .ui_min = 200,
                      .ui_max = 20000,
                      .help = "Number of tiles; about as many are made",
                      .symbol = "n"});
  v.number(
      p.variation,
      {.key = "variation",
       .min = 1,
       .max = 8,
       .ui_min = 1,
       .ui_max = 8,
       .help = "Side of the largest tiles, in plain parts, against the smallest, in detailed ones; 1 makes all alike",
       .symbol = "alpha"});
  v.choice(
      p.sizes_by, {.key = "sizesBy", .help = "Where tiles are small", .advanced = true},
      {{SizesBy::kDetail, "detail", "where much happens: where the picture's gradient is long"},
       {SizesBy::kSaliency, "saliency", "in what draws the eye: where colours are far from the picture's mean"}});
  v.number(p.grout, {.key = "grout",
                     .min = 0,
                     .max = 64,
                     .ui_min = 0,
                     .ui_max = 6,
                     .unit = "px",
                     .help = "Grout between tiles; small tiles get less"});
  v.choice(p.shape, {.key = "shape", .help = "Shape of a tile"},
           {{Shape::kQuad, "quad", "hand-cut, four corners, fitted to its neighbours"},
            {Shape::kSquare, "square", "squares of delta times the space there is"},
            {Shape::kRectangle, "rectangle", "the same, as long and narrow as aspect says"},
            {Shape::kTrapezoid, "trapezoid", "rectangles that widen as far as rows fan out round a curve"},
            {Shape::kMoment, "moment", "rectangles with the second moments of their cells, times delta"},
            {Shape::kEllipse, "ellipse", "brush strokes, overlapping where delta is above 1"},
            {Shape::kCell, "cell", "the Voronoi cells themselves"}});
  v.text(p.palette, {.key = "palette",
                     .help = "Colours of tile: empty for each tile's own, a number for so many (2 to 256), or a list "
                             "such as \"chalk #f4f1e8, brick #8c4a32\""});
  v.choice(p.style, {.key = "style", .help = "How tiles are laid"},
           {{Style::kVermiculatum, "opus-vermiculatum", "rows along the contours, then rows along these"},
            {Style::kHausner, "hausner", "the paper's: random first positions, edges by avoidance alone"}});
  v.flag(
      p.seamless,
      {.key = "seamless",
       .help = "A texture: the tiles at the right continue those at the left, those at the bottom those at the top"});
  v.number(p.aspect, {.key = "aspect",
                      .min = 0.2,
                      .max = 5,
                      .ui_min = 0.5,
                      .ui_max = 4,
                      .help = "Length of a tile along the edges against its width",
                      .symbol = "beta^2"});
  v.integer(p.iterations, {.key = "iterations",
                           .min = 0,
                           .max = 1000,
                           .ui_min = 0,
                           .ui_max = 60,
                           .help = "Lloyd iterations of the centroidal Voronoi diagram"});
  v.number(p.delta, {.key = "delta",
                     .min = 0.1,
                     .max = 3,
                     .ui_min = 0.5,
                     .ui_max = 1.5,
                     .help = "Side of a square, rectangle, trapezoid or ellipse against the space it has",
                     .symbol = "delta",
                     .advanced = true});
  v.flag(p.clip, {.key = "clip",
                  .help = "Squares, rectangles and trapezoids are cut where they would overlap",
                  .advanced = true});
  v.flag(p.chips,
         {.key = "chips",
          .help = "Splinters fill what squares, rectangles, trapezoids and moment tiles leave of their cells",
          .advanced = true});
  v.number(p.tolerance, {.key = "tolerance",
                         .min = 0,
                         .max = 10,
                         .ui_min = 0,
                         .ui_max = 2,
                         .unit = "px",
                         .help = "Stop iterating when tiles move less than this on average; 0 does all iterations",
                         .advanced = true});
  v.number(p.avoidance, {.key = "avoidance",
                         .min = 0,
                         .max = 2,
                         .ui_min = 0,
                         .ui_max = 1,
                         .help = "Width of the edges that drive tiles away during the iterations, in tile sides",
                         .advanced = true});
  v.integer(p.settle, {.key = "settle",
                       .min = 0,
                       .max = 100,
                       .ui_min = 0,
                       .ui_max = 10,
                       .help = "How many of the iterations are the last ones, without such edges",
                       .advanced = true});
  v.number(p.edge_share,
           {.key = "edgeShare",
            .min = 0,
            .max = 0.5,
            .ui_min = 0,
            .ui_max = 0.4,
            .help = "Share of the pixels whose contrast is strong enough to begin an edge; 0 finds none",
            .advanced = true});
  v.number(p.edge_detail, {.key = "edgeDetail",
                           .min = 0.02,
                           .max = 1,
                           .ui_min = 0.05,
                           .ui_max = 0.5,
                           .help = "What is finer than this is no edge, in tile sides",
                           .advanced = true});
  v.number(p.smoothing, {.key = "smoothing",
                         .min = 0,
                         .max = 100,
                         .ui_min = 0,
                         .ui_max = 20,
                         .help = "How much the directions that edges give are evened out between them",
                         .advanced = true});
  v.text(
      p.region_sizes,
      {.key = "regionSizes", .help = "Sizes of the tiles for each colour of the regions picture", .advanced = true});
  v.choice(p.sample, {.key = "sample", .help = "Colour of a tile", .advanced = true},
           {{Sample::kMean, "mean", "mean of the pixels under it, in linear light"},
            {Sample::kPoint, "point", "the pixel at its centre"}});
  v.number(p.width_mm, {.key = "widthMm",
                        .min = 0,
                        .max = 1000000,
                        .ui_min = 0,
                        .ui_max = 10000,
                        .unit = "mm",
                        .help = "Width of the mosaic; 0 leaves SVG in pixels and takes 1 px as 1 mm in DXF",
                        .advanced = true});
}
// clang-format on

// Cross-field checks, after each field is within its own range: report(key, message).
template <class Report>
void check(const Params& p, Report&& report) {
  TilePalette palette;
  if (!parse_palette(p.palette, palette))
    report(
        "palette",
        "is no palette, expected nothing, a whole number, 2 to 256, or colours such as \"chalk #f4f1e8, #8c4a32\"");
  std::vector<RegionSize> sizes;
  if (!parse_region_sizes(p.region_sizes, sizes))
    report("regionSizes",
           "is no list of sizes, expected colours with 0.05 to 20 each, such as \"#0000ff=1.6 #00ff00=1\"");
}

}  // namespace tessera::mosaic

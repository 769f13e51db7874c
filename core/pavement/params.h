// Parameters of the pavement technique; symbols and sections are those of the paper on the Copacabana sidewalk.
#pragma once

#include "tessera/base/parameter.h"

namespace tessera::pavement {

enum class Method { kFlow, kPaper };
enum class Distance { kExact, kChamfer };

inline constexpr int kLeastTile = 64;  // in half sides: tiles are wider than what lies around them

struct Params {
  double half_side = 4;
  int sites = 0;
  double grout = 0.5;
  int colors = 2;
  double threshold = 0;
  double stretch_min = 0.5;
  double stretch_max = 2;
  int iterations = 20;
  double wide_angle = 120;
  double cap_scale = 0.5;
  double noise_scale = 24;
  int supersample = 0;
  double width_mm = 0;
  int tiles = 0;
  Distance distance = Distance::kExact;
  Method method = Method::kFlow;
};

// clang-format off: a parameter is read as a line or two, not as a column
template <class Visitor>
void visit(Visitor& v, Params& p) {
  v.number(p.half_side, {.key = "halfSide", .min = 1, .max = 512, .ui_min = 2, .ui_max = 24, .unit = "px",
                         .help = "Half the side of a stone", .symbol = "h"});
  v.number(p.grout, {.key = "grout", .min = 0, .max = 256, .ui_min = 0, .ui_max = 4, .unit = "px",
                     .help = "Grout between stones; corners move towards a stone's centre by half of it"});
  v.number(p.stretch_min, {.key = "stretchMin", .min = 0.1, .max = 10, .ui_min = 0.25, .ui_max = 2,
                           .help = "Least stretch of a stone, drawn at random up to stretchMax", .symbol = "s_x"});
  v.number(p.stretch_max, {.key = "stretchMax", .min = 0.1, .max = 10, .ui_min = 0.5, .ui_max = 4,
                           .help = "Largest stretch of a stone", .symbol = "s_x"});
  v.integer(p.colors, {.key = "colors", .min = 2, .max = 16, .ui_min = 2, .ui_max = 8,
                       .help = "Colours of stone: 2 is black and white, more take the drawing's own colours"});
  v.integer(p.iterations, {.key = "iterations", .min = 0, .max = 1000, .ui_min = 0, .ui_max = 60,
                           .help = "Lloyd iterations of the centroidal Voronoi diagram"});
  v.number(p.threshold, {.key = "threshold", .min = 0, .max = 1, .ui_min = 0, .ui_max = 1,
                         .help = "Grey between black and white, 0 to 1; 0 finds it (Otsu)", .advanced = true});
  v.number(p.wide_angle, {.key = "wideAngle", .min = 60, .max = 180, .ui_min = 90, .ui_max = 180, .unit = "deg",
                          .help = "Corners wider than this are straightened", .advanced = true});
  v.integer(p.sites, {.key = "sites", .min = 0, .max = 4194304, .ui_min = 0, .ui_max = 50000,
                      .help = "Number of stones; 0 derives it from halfSide (Eq. 1)", .symbol = "n",
                      .advanced = true});
  v.number(p.cap_scale, {.key = "capScale", .min = 0, .max = 1, .ui_min = 0, .ui_max = 1,
                         .help = "Half side of a pyramid's cap, as a part of halfSide", .symbol = "c",
                         .advanced = true});
  v.number(p.noise_scale, {.key = "noiseScale", .min = 2, .max = 1000, .ui_min = 4, .ui_max = 100, .unit = "stones",
                           .help = "Wavelength of the noise that turns stones far from edges", .advanced = true});
  v.integer(p.supersample, {.key = "supersample", .min = 0, .max = 4, .ui_min = 0, .ui_max = 4,
                            .help = "Diagram pixels a source pixel; 0 chooses more where lines are hair-thin",
                            .advanced = true});
  v.number(p.width_mm, {.key = "widthMm", .min = 0, .max = 1000000, .ui_min = 0, .ui_max = 10000, .unit = "mm",
                        .help = "Width of the pavement; 0 leaves SVG in pixels and takes 1 px as 1 mm in DXF",
                        .advanced = true});
  v.integer(p.tiles, {.key = "tiles", .min = 0, .max = 1048576, .ui_min = 0, .ui_max = 8192, .unit = "px",
                      .help = "Side of the tiles that a drawing too large for memory is paved in; 0: all at once",
                      .advanced = true, .bare = "2048"});
  v.choice(p.distance, {.key = "distance", .help = "Distance to the drawing's edges", .advanced = true},
           {{Distance::kExact, "exact", "exact Euclidean distance"},
            {Distance::kChamfer, "chamfer", "quasi-Euclidean 3x3 chamfer, as the paper"}});
  v.choice(p.method, {.key = "method", .help = "How cells become stones", .advanced = true},
           {{Method::kFlow, "flow", "sub-pixel junctions, four corners a stone by matching"},
            {Method::kPaper, "paper", "the paper's steps to the letter"}});
}
// clang-format on

// Cross-field checks, after each field is within its own range: report(key, message).
template <class Report>
void check(const Params& p, Report&& report) {
  if (p.stretch_min > p.stretch_max) report("stretchMin", "is larger than stretchMax; expected at most stretchMax");
  if (p.tiles > 0 && p.tiles < kLeastTile * p.half_side)
    report("tiles", "is less than 64 times halfSide; expected at least that, or 0");
  if (p.tiles > 0 && p.method == Method::kPaper)
    report("tiles", "cannot be with the method paper, whose vertices no tile can settle alone; expected 0");
}

}  // namespace tessera::pavement

// Parameters of random patterns; symbols and sections are those of "Random Pattern Generation Processes" (Schachter
// and Ahuja 1979).
#pragma once

#include <cmath>
#include <string>

#include "tessera/base/parameter.h"
#include "tessera/patterns/colours.h"

namespace tessera::patterns {

enum class Model {
  kPoissonLines,
  kOccupancy,
  kDelaunay,
  kJohnsonMehl,
  kCheckerboard,
  kHexagon,
  kTriangle,
  kGaussian,
  kSegments,
  kEllipses,
  kCircles,
  kRectangles,
  kPixels,
  kPoints
};
enum class Process { kPoisson, kBinomial, kCluster, kMatern1, kMatern2, kMixed, kCox, kBlueNoise };
enum class Variation { kNone, kCell, kWithin };

inline constexpr double kFromSize = -1;  // an intensity that follows from the size

struct Params {
  Model model = Model::kOccupancy;
  double size = 24;
  double intensity = kFromSize;
  double width = 512, height = 512;
  std::string colors = "#b5533c #e4dbcb #22313f #7a8f94";
  std::string probabilities;
  Variation variation = Variation::kNone;
  std::string covariance = "60";
  double border = 0;
  std::string border_color = "#1b1a18";
  int filter = 1;
  int channels = 3;
  bool seamless = false;
  Process process = Process::kPoisson;
  double family = 8;
  double spread = 8;
  double inhibition = 4;
  double mixing = 0.5;
  double field_scale = 64;
  double field_deviation = 1;
  double grid = 8;
  double speed = 1;
  double length = 20;
  double breadth = 8;
  double size_variation = 0;
  double correlation = 0;
  double dot = 1.5;
  double width_mm = 0;
};

inline ColourTexts texts_of(const Params& p) {
  return {p.channels, p.colors, p.probabilities, p.covariance, p.border_color};
}

// The intensity of the driving process, as given or as it follows from the size: points, lines or nuclei.
double driving_intensity(const Params& params);
// About how many cells, bombs or points there will be.
double expected_pieces(const Params& params);

// clang-format off: a parameter is read as a line or two, not as a column
template <class Visitor>
void visit(Visitor& v, Params& p) {
  v.choice(p.model, {.key = "model", .help = "What makes the pattern"},
           {{Model::kPoissonLines, "poisson-lines", "random lines cut the plane into cells (3.2 a)"},
            {Model::kOccupancy, "occupancy", "each place goes to the nearest point: Voronoi cells (3.2 b)"},
            {Model::kDelaunay, "delaunay", "triangles between neighbouring points"},
            {Model::kJohnsonMehl, "johnson-mehl", "points come one after another and grow until they meet"},
            {Model::kCheckerboard, "checkerboard", "squares, turned and shifted at random (3.3 a)"},
            {Model::kHexagon, "hexagon", "regular hexagons, turned and shifted at random (3.3 b)"},
            {Model::kTriangle, "triangle", "regular triangles, turned and shifted at random (3.3 c)"},
            {Model::kGaussian, "gaussian", "each pixel a cell of its own: noise (3.1)"},
            {Model::kSegments, "segments", "bombing: random line segments (4 a)"},
            {Model::kEllipses, "ellipses", "bombing: random ellipses (4 b)"},
            {Model::kCircles, "circles", "bombing: random circles (4 c)"},
            {Model::kRectangles, "rectangles", "bombing: random rectangles (4 d)"},
            {Model::kPixels, "pixels", "bombing: random single pixels (4 c)"},
            {Model::kPoints, "points", "the points of a process by themselves (2)"}});
  v.number(p.size, {.key = "size",
                    .min = 0.5,
                    .max = 100000,
                    .ui_min = 4,
                    .ui_max = 128,
                    .unit = "px",
                    .help = "Side of a checkerboard's, hexagon's or triangle's cell; of other models the side of a square "
                            "as large as the mean cell, or as a point's or bomb's share of the plane",
                    .symbol = "b"});
  v.number(p.intensity, {.key = "intensity",
                         .min = kFromSize,
                         .max = 1000000,
                         .ui_min = 0,
                         .ui_max = 0.02,
                         .help = "Of the driving process: points, nuclei, parents or bombs a square pixel (Johnson-Mehl: "
                                 "and a second), lines a pixel and radian; -1 follows from size",
                         .symbol = "lambda",
                         .advanced = true});
  v.number(p.width, {.key = "width", .min = 1, .max = 65536, .ui_min = 64, .ui_max = 2048, .unit = "px",
                     .help = "Width of the window"});
  v.number(p.height, {.key = "height", .min = 1, .max = 65536, .ui_min = 64, .ui_max = 2048, .unit = "px",
                      .help = "Height of the window"});
  v.text(p.colors, {.key = "colors",
                    .help = "Colours of the cells; of a bombing model that of the bombs, then that of the ground",
                    .symbol = "mu"});
  v.text(p.probabilities, {.key = "probabilities",
                           .help = "Shares of the colours, such as \"0.5 0.3 0.2\"; empty makes all alike",
                           .symbol = "p"});
  v.choice(p.variation, {.key = "variation", .help = "How far a cell's colour is from its mean"},
           {{Variation::kNone, "none", "not at all"},
            {Variation::kCell, "cell", "each cell's is drawn from the colour's normal distribution"},
            {Variation::kWithin, "within", "each pixel's is (in the picture; vectors keep the mean)"}});
  v.text(p.covariance, {.key = "covariance",
                        .help = "Of those distributions, in levels squared: a variance, one a channel (red, green, blue) or "
                                "the upper half of the matrix (rr rg rb gg gb bb), for all colours or, with semicolons "
                                "between, for each",
                        .symbol = "Sigma",
                        .advanced = true});
  v.number(p.border, {.key = "border", .min = 0, .max = 256, .ui_min = 0, .ui_max = 12, .unit = "px",
                      .help = "Thickness of the borders between cells"});
  v.text(p.border_color, {.key = "borderColor", .help = "Their colour, and that of the ground under points",
                          .advanced = true});
  v.integer(p.filter, {.key = "filter", .min = 1, .max = 99, .ui_min = 1, .ui_max = 15, .unit = "px",
                       .help = "Side of the square over which the picture's pixels are averaged; 1: none",
                       .symbol = "n",
                       .advanced = true});
  v.integer(p.channels, {.key = "channels", .min = 1, .max = 4, .ui_min = 1, .ui_max = 4,
                         .help = "Of the picture: 1 grey, 2 grey and opacity, 3 RGB, 4 RGB and opacity (colors are then "
                                 "#rrggbbaa)",
                         .advanced = true});
  v.flag(p.seamless, {.key = "seamless",
                      .help = "A texture: what leaves the window at the right comes in at the left, and so on"});
  v.choice(p.process, {.key = "process", .help = "The points of points, cells and bombs (2)", .advanced = true},
           {{Process::kPoisson, "poisson", "independent of each other"},
            {Process::kBinomial, "binomial", "on a grid, each of its points with the same chance"},
            {Process::kCluster, "cluster", "families about parents (Neyman-Scott)"},
            {Process::kMatern1, "matern-1", "without points that have one within twice the inhibition (Matern I)"},
            {Process::kMatern2, "matern-2", "without points that come so near to an earlier one (Matern II)"},
            {Process::kMixed, "mixed", "Poisson, of an intensity that is random itself"},
            {Process::kCox, "cox", "Poisson, of an intensity that varies by place (doubly stochastic)"},
            {Process::kBlueNoise, "blue-noise", "as even as random points can be (Bridson)"}});
  v.number(p.family, {.key = "family", .min = 0, .max = 10000, .ui_min = 1, .ui_max = 40,
                      .help = "Mean number of points in a cluster", .symbol = "E[N]", .advanced = true});
  v.number(p.spread, {.key = "spread", .min = 0, .max = 10000, .ui_min = 1, .ui_max = 40, .unit = "px",
                      .help = "Standard deviation of the points of a cluster about its parent", .advanced = true});
  v.number(p.inhibition, {.key = "inhibition", .min = 0, .max = 10000, .ui_min = 0, .ui_max = 20, .unit = "px",
                          .help = "Half the distance that points of the Matern processes keep", .symbol = "d",
                          .advanced = true});
  v.number(p.mixing, {.key = "mixing", .min = 0, .max = 10, .ui_min = 0, .ui_max = 2,
                      .help = "Coefficient of variation of the mixed process's intensity", .advanced = true});
  v.number(p.field_scale, {.key = "fieldScale", .min = 0.5, .max = 100000, .ui_min = 8, .ui_max = 256, .unit = "px",
                           .help = "How far the cox process's intensity stays alike", .advanced = true});
  v.number(p.field_deviation, {.key = "fieldDeviation", .min = 0, .max = 3, .ui_min = 0, .ui_max = 2,
                               .help = "Standard deviation of the logarithm of the cox process's intensity",
                               .advanced = true});
  v.number(p.grid, {.key = "grid", .min = 0.5, .max = 10000, .ui_min = 1, .ui_max = 40, .unit = "px",
                    .help = "Spacing of the binomial process's grid", .advanced = true});
  v.number(p.speed, {.key = "speed", .min = 0.000001, .max = 1000000, .ui_min = 0.1, .ui_max = 10, .unit = "px/s",
                     .help = "How fast a Johnson-Mehl cell grows", .symbol = "v", .advanced = true});
  v.number(p.length, {.key = "length", .min = 0, .max = 10000, .ui_min = 1, .ui_max = 100, .unit = "px",
                      .help = "Length of a segment or rectangle, major axis of an ellipse, diameter of a circle",
                      .symbol = "2 c1"});
  v.number(p.breadth, {.key = "breadth", .min = 0, .max = 10000, .ui_min = 1, .ui_max = 100, .unit = "px",
                       .help = "Width of a rectangle, minor axis of an ellipse", .symbol = "2 c2"});
  v.number(p.size_variation, {.key = "sizeVariation", .min = 0, .max = 3, .ui_min = 0, .ui_max = 1,
                              .help = "Coefficient of variation of the bombs' sizes (gamma distribution); 0: all alike",
                              .advanced = true});
  v.number(p.correlation, {.key = "correlation", .min = 0, .max = 1000, .ui_min = 0, .ui_max = 40, .unit = "px",
                           .help = "How far the gaussian model's colours stay alike; 0: not at all", .advanced = true});
  v.number(p.dot, {.key = "dot", .min = 0.01, .max = 100, .ui_min = 0.5, .ui_max = 5, .unit = "px",
                   .help = "Radius of a drawn point; half the thickness of a segment", .advanced = true});
  v.number(p.width_mm, {.key = "widthMm", .min = 0, .max = 1000000, .ui_min = 0, .ui_max = 10000, .unit = "mm",
                        .help = "Width of the pattern; 0 leaves SVG in pixels and takes 1 px as 1 mm in DXF",
                        .advanced = true});
}
// clang-format on

// Cross-field checks, after each field is within its own range: report(key, message).
template <class Report>
void check(const Params& p, Report&& report) {
  if (p.intensity < 0 && p.intensity != kFromSize)
    report("intensity", "is below 0, expected 0 or more, or -1 for one that follows from size");
  ColourModel colours;
  Levels border;
  for (const ColourProblem& problem : read_colours(texts_of(p), colours, border)) report(problem.key, problem.message);
}

}  // namespace tessera::patterns

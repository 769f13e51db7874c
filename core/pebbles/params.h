// Parameters of the pebbles technique; symbols and sections are those of the paper (docs/pebbles.md).
#pragma once

#include <string>

#include "tessera/base/parameter.h"
#include "tessera/pebbles/edits.h"

namespace tessera::pebbles {

enum class Segmenter { kTree, kRays, kLabels };
enum class Height { kPercentile, kLeast, kMinorAxis };
enum class FieldLayout { kNodes, kMerged, kBoth };
enum class Collider { kNone, kHull };
enum class Strewing { kBlueNoise, kInhibition, kCluster, kPoisson };

struct Params {
  int width = 900;
  Segmenter segmenter = Segmenter::kTree;
  double smallest = 6;
  double contrast = 2;
  double edge_ratio = 0.85;
  int median_radius = 2;
  std::string edits;
  double width_m = 0;
  double pixels_per_m = 0;
  Height height = Height::kPercentile;
  double height_factor = 1;
  double flatten = 0;
  int lod = 0;
  double mesh_error = 0.5;
  double relief = 0;
  bool normal_map = false;
  double roughness = 0.8;
  FieldLayout layout = FieldLayout::kNodes;
  bool ground = false;
  bool ground_hole = false;
  Collider collider = Collider::kNone;
  bool quantize = false;
  int scatter = 0;
  Strewing strewing = Strewing::kPoisson;
  int prototypes = 24;
  bool instancing = true;
};

// World size of a pixel of a photo `width` px wide.
inline double metres_per_pixel(const Params& p, int width) {
  if (p.pixels_per_m > 0) return 1 / p.pixels_per_m;
  return (p.width_m > 0 ? p.width_m : 1) / width;
}

// clang-format off: a parameter is read as a line or two, not as a column
template <class Visitor>
void visit(Visitor& v, Params& p) {
  v.integer(p.width, {.key = "width",
                      .min = 64,
                      .max = 20000,
                      .ui_min = 300,
                      .ui_max = 3000,
                      .unit = "px",
                      .help = "Width at which the photo is searched; it is never enlarged",
                      .symbol = "w"});
  v.choice(p.segmenter, {.key = "segmenter", .help = "How pebbles are found"},
           {{Segmenter::kTree, "tree", "regions of a watershed, joined where the sum looks most like pebbles"},
            {Segmenter::kRays, "rays", "the paper's: rays from sample points to the edges around"},
            {Segmenter::kLabels, "labels", "not at all: a label picture made elsewhere says where they are"}});
  v.number(p.smallest, {.key = "smallest",
                        .min = 2,
                        .max = 1000,
                        .ui_min = 4,
                        .ui_max = 60,
                        .unit = "px",
                        .help = "Diameter of the smallest pebble, at the width that is searched"});
  v.number(
      p.contrast,
      {.key = "contrast",
       .min = 0,
       .max = 100,
       .ui_min = 0,
       .ui_max = 5,
       .help = "How much a pebble's colour must differ from what lies around, against the grain of its surface"});
  v.number(p.width_m, {.key = "widthM",
                       .min = 0,
                       .max = 100000,
                       .ui_min = 0,
                       .ui_max = 10,
                       .unit = "m",
                       .help = "Width of the photo in the world; 0 takes pixelsPerM, or 1 m"});
  v.choice(p.height, {.key = "height", .help = "Half the height of a pebble"},
           {{Height::kPercentile, "percentile", "5th percentile of its radii"},
            {Height::kLeast, "least", "the paper's: its least radius, which one bad ray spoils"},
            {Height::kMinorAxis, "minor-axis", "half its shorter axis"}});
  v.number(p.height_factor,
           {.key = "heightFactor", .min = 0.05, .max = 4, .ui_min = 0.2, .ui_max = 2, .help = "Times this"});
  v.number(p.flatten, {.key = "flatten",
                       .min = 0,
                       .max = 1,
                       .ui_min = 0,
                       .ui_max = 1,
                       .help = "How much of a pebble's lower half is cut off level with the ground"});
  v.integer(p.lod, {.key = "lod",
                    .min = 0,
                    .max = 3,
                    .ui_min = 0,
                    .ui_max = 3,
                    .help = "Level of detail: 0 the finest, each next one with half the vertices around"});
  v.choice(p.layout, {.key = "layout", .help = "Nodes of the 3D scene"},
           {{FieldLayout::kNodes, "nodes", "one a pebble"},
            {FieldLayout::kMerged, "merged", "one for all"},
            {FieldLayout::kBoth, "both", "one a pebble, and one for all of a second scene"}});
  v.flag(p.ground, {.key = "ground", .help = "The ground between the pebbles as a textured plane"});
  v.flag(p.ground_hole, {.key = "groundHole",
                         .help = "The ground's picture without the pebbles: what remains when they are taken away",
                         .advanced = true});
  v.number(p.edge_ratio, {.key = "edgeRatio",
                          .min = 0.05,
                          .max = 1,
                          .ui_min = 0.5,
                          .ui_max = 1,
                          .help = "Segmenter rays: below this share of a neighbour's lightness a pixel is an edge",
                          .symbol = "tau",
                          .advanced = true});
  v.integer(p.median_radius, {.key = "medianRadius",
                              .min = 0,
                              .max = 100,
                              .ui_min = 0,
                              .ui_max = 15,
                              .unit = "px",
                              .help = "Segmenter rays: radius of the median filter that takes texture away",
                              .symbol = "r",
                              .advanced = true});
  v.number(p.pixels_per_m, {.key = "pixelsPerM",
                            .min = 0,
                            .max = 1000000,
                            .ui_min = 0,
                            .ui_max = 5000,
                            .unit = "px/m",
                            .help = "Pixels of the photo to a metre, in place of widthM; 0 leaves it to that",
                            .advanced = true});
  v.number(p.mesh_error, {.key = "meshError",
                          .min = 0.05,
                          .max = 20,
                          .ui_min = 0.1,
                          .ui_max = 4,
                          .unit = "px",
                          .help = "How far a mesh may stay off the outline",
                          .symbol = "e",
                          .advanced = true});
  v.number(p.relief, {.key = "relief",
                      .min = 0,
                      .max = 1,
                      .ui_min = 0,
                      .ui_max = 1,
                      .help = "Bumps from the photo's shading, as a share of a tenth of the pebble's height",
                      .advanced = true});
  v.flag(p.normal_map, {.key = "normalMap", .help = "A normal map from the photo's shading", .advanced = true});
  v.number(p.roughness, {.key = "roughness",
                         .min = 0,
                         .max = 1,
                         .ui_min = 0,
                         .ui_max = 1,
                         .help = "Roughness of the material: 0 wet and shiny, 1 dry",
                         .advanced = true});
  v.choice(p.collider, {.key = "collider", .help = "Shapes for an engine's physics", .advanced = true},
           {{Collider::kNone, "none", "none"},
            {Collider::kHull, "hull", "a convex hull a pebble, of at most 32 vertices"}});
  v.flag(p.quantize, {.key = "quantize",
                      .help = "Smaller files: whole numbers for positions, normals and texture "
                              "coordinates (KHR_mesh_quantization)",
                      .advanced = true});
  v.integer(p.scatter, {.key = "scatter",
                        .min = 0,
                        .max = 1000000,
                        .ui_min = 0,
                        .ui_max = 5000,
                        .help = "So many pebbles strewn anew, instances of those found; 0 keeps the photo's places",
                        .advanced = true});
  v.choice(p.strewing, {.key = "strewing", .help = "How strewn pebbles lie", .advanced = true},
           {{Strewing::kBlueNoise, "blue-noise", "evenly"},
            {Strewing::kInhibition, "inhibition", "apart, but with gaps of all sizes (Matern II)"},
            {Strewing::kCluster, "cluster", "in groups"},
            {Strewing::kPoisson, "poisson", "at random, wherever there is room"}});
  v.integer(p.prototypes, {.key = "prototypes",
                           .min = 1,
                           .max = 1000,
                           .ui_min = 1,
                           .ui_max = 100,
                           .help = "Of how many of the pebbles found those strewn are made",
                           .symbol = "K",
                           .advanced = true});
  v.flag(p.instancing, {.key = "instancing",
                        .help = "Strewn pebbles as instances (EXT_mesh_gpu_instancing); else as a node each, which "
                                "every program knows",
                        .advanced = true});
  v.text(p.edits, {.key = "edits",
                   .help = "Corrections of what was found, such as \"merge 120,44 130,60; delete 5,8\"",
                   .advanced = true});
}
// clang-format on

// Cross-field checks, after each field is within its own range: report(key, message).
template <class Report>
void check(const Params& p, Report&& report) {
  std::vector<Edit> edits;
  if (!parse_edits(p.edits, edits))
    report("edits", "is no list of edits, expected such as \"merge 120,44 130,60; split 9,9 20,9; delete 5,8\"");
}

}  // namespace tessera::pebbles

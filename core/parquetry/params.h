// Parameters of parquetry; symbols and sections are those of "Computational Parquetry: Fabricated Style Transfer with
// Wood Pixels" (Iseringhausen, Weinmann, Huang and Hullin 2020), defaults those of its Table 1.
#pragma once

#include <string>

#include "tessera/base/parameter.h"
#include "tessera/parquetry/panel_options.h"
#include "tessera/parquetry/pins.h"
#include "tessera/parquetry/registration.h"

namespace tessera::parquetry {

enum class Order { kSaliency, kCentre, kRows };
enum class Sequence { kSequential, kInterleaved };
enum class Side { kBack, kFront };
enum class ThinParts { kRepair, kRefuse };
enum class Enclosed { kSplit, kKeep };
enum class Grain { kAny, kAligned, kDegrees };
enum class GridKind { kRegular, kMorphed };
enum class SeamKind { kNone, kG0, kG1 };

struct Params {
  double image_size_mm = 360;
  double patch_mm = 14;
  int rotations = 15;
  double weight_intensity = 0.5;
  double weight_edge = 0.5;
  double weight_histogram = 0.5;
  double weight_colour = 0;
  double resolution_dpi = 0;
  int adaptive_levels = 0;
  double adaptive_factor = 1.2;
  GridKind grid = GridKind::kRegular;
  double attraction = 4;
  double attraction_mm = 0;
  std::string pins;
  SeamKind seams = SeamKind::kNone;
  double overlap_mm = 0;
  double seam_error_mm = 0.1;
  Order order = Order::kSaliency;
  int copies = 1;
  Sequence sequence = Sequence::kSequential;
  Grain grain = Grain::kAny;
  double grain_degrees = 20;
  double kerf_mm = 0.2;
  double clearance_mm = 1;
  double min_width_mm = 5;
  Side side = Side::kBack;
  int posterize = 0;
  double largest_patch = 5;
  ThinParts thin_parts = ThinParts::kRepair;
  Enclosed enclosed = Enclosed::kSplit;
  int improve_tries = 0;
  double cut_speed = 20;
  std::string panels;
  Registration registration = Registration::kSimilarity;
};

// clang-format off: a parameter is read as a line or two, not as a column
template <class Visitor>
void visit(Visitor& v, Params& p) {
  v.number(p.image_size_mm, {.key = "imageSizeMm",
                             .min = 10,
                             .max = 10000,
                             .ui_min = 50,
                             .ui_max = 1000,
                             .unit = "mm",
                             .help = "Shorter side of the finished piece",
                             .symbol = "s_image"});
  v.number(p.patch_mm, {.key = "patchMm",
                        .min = 2,
                        .max = 1000,
                        .ui_min = 5,
                        .ui_max = 40,
                        .unit = "mm",
                        .help = "Side of a patch",
                        .symbol = "s_patch"});
  v.integer(p.rotations, {.key = "rotations",
                          .min = 1,
                          .max = 360,
                          .ui_min = 1,
                          .ui_max = 36,
                          .help = "Directions in which wood is laid, over a full turn",
                          .symbol = "n_rot"});
  v.number(p.weight_intensity, {.key = "weightIntensity",
                                .min = 0,
                                .max = 1,
                                .ui_min = 0,
                                .ui_max = 1,
                                .help = "How much light and dark matter",
                                .symbol = "w_intens"});
  v.number(p.weight_edge, {.key = "weightEdge",
                           .min = 0,
                           .max = 1,
                           .ui_min = 0,
                           .ui_max = 1,
                           .help = "How much edges and grain matter",
                           .symbol = "w_edge"});
  v.number(p.weight_histogram, {.key = "weightHistogram",
                                .min = 0,
                                .max = 1,
                                .ui_min = 0,
                                .ui_max = 1,
                                .help = "How far the target's tones are moved to those of the wood",
                                .symbol = "w_hist"});
  v.choice(p.grid, {.key = "grid", .help = "What the picture is cut into"},
           {{GridKind::kRegular, "regular", "squares"},
            {GridKind::kMorphed, "morphed", "cells whose sides follow the picture's edges"}});
  v.choice(p.seams, {.key = "seams", .help = "Whether cuts between patches are laid where the picture gains most"},
           {{SeamKind::kNone, "none", "straight cuts"},
            {SeamKind::kG0, "g0", "curves that may have corners"},
            {SeamKind::kG1, "g1", "smooth curves"}});
  v.choice(p.order, {.key = "order", .help = "Which patches choose their wood first"},
           {{Order::kSaliency, "saliency", "those that draw the eye"},
            {Order::kCentre, "centre", "those nearest to the middle"},
            {Order::kRows, "rows", "row by row from the top"}});
  v.choice(p.grain, {.key = "grain", .help = "Which way the wood may be turned"},
           {{Grain::kAny, "any", "every way"},
            {Grain::kAligned, "aligned", "as it lies on the panel, or upside down"},
            {Grain::kDegrees, "degrees", "up to grainDegrees off that"}});
  v.number(p.kerf_mm, {.key = "kerfMm",
                       .min = 0,
                       .max = 5,
                       .ui_min = 0,
                       .ui_max = 1,
                       .unit = "mm",
                       .help = "Width of the cut; outlines are moved outwards by half of it"});
  v.number(p.clearance_mm, {.key = "clearanceMm",
                            .min = 0,
                            .max = 50,
                            .ui_min = 0,
                            .ui_max = 5,
                            .unit = "mm",
                            .help = "Least distance between cuts, and from them to the edge of the wood"});
  v.number(p.min_width_mm, {.key = "minWidthMm",
                            .min = 0.5,
                            .max = 100,
                            .ui_min = 2,
                            .ui_max = 20,
                            .unit = "mm",
                            .help = "Least width of a piece anywhere"});
  v.choice(p.side, {.key = "side", .help = "From which side the panels are cut"},
           {{Side::kBack, "back", "the back, mirrored: the laser's scorch marks stay behind"},
            {Side::kFront, "front", "the front, as scanned"}});
  v.integer(p.copies, {.key = "copies",
                       .min = 1,
                       .max = 1000,
                       .ui_min = 1,
                       .ui_max = 10,
                       .help = "How often each target is made of the same wood",
                       .advanced = true});
  v.choice(p.sequence,
           {.key = "sequence", .help = "How several targets or copies take turns at the wood", .advanced = true},
           {{Sequence::kSequential, "sequential", "one after the other"},
            {Sequence::kInterleaved, "interleaved", "patch by patch, as if all were one"}});
  v.integer(p.posterize, {.key = "posterize",
                          .min = 0,
                          .max = 16,
                          .ui_min = 0,
                          .ui_max = 8,
                          .help = "How many tones the picture is reduced to, the regions of which are the patches; "
                                  "0 lays a grid"});
  v.number(p.largest_patch, {.key = "largestPatch",
                             .min = 1,
                             .max = 1000,
                             .ui_min = 2,
                             .ui_max = 20,
                             .help = "Regions of posterize that are longer than this times patchMm are split",
                             .advanced = true});
  v.choice(p.thin_parts,
           {.key = "thinParts",
            .help = "What becomes of parts of a segmentation that are narrower than minWidthMm",
            .advanced = true},
           {{ThinParts::kRepair, "repair", "they go to the pieces beside them"},
            {ThinParts::kRefuse, "refuse", "nothing is made, and a message tells where they are"}});
  v.choice(p.enclosed, {.key = "enclosed", .help = "What becomes of pieces around others", .advanced = true},
           {{Enclosed::kSplit, "split", "they are cut apart, so that none has a hole, which breaks easily"},
            {Enclosed::kKeep, "keep", "they have holes, in which the others lie"}});
  v.integer(p.improve_tries, {.key = "improveTries",
                              .min = 0,
                              .max = 1e9,
                              .ui_min = 0,
                              .ui_max = 1000,
                              .help = "How often pieces try to exchange their wood for better, after all have some",
                              .advanced = true});
  v.number(p.cut_speed, {.key = "cutSpeed",
                         .min = 0.01,
                         .max = 10000,
                         .ui_min = 1,
                         .ui_max = 100,
                         .unit = "mm/s",
                         .help = "How fast the machine cuts; the report tells how long it takes",
                         .advanced = true});
  v.text(p.panels, {.key = "panels",
                    .help = "What is known of each panel: oak dpi=300 margin=5; walnut machine=10:10,160:10,10:110",
                    .advanced = true});
  v.choice(p.registration,
           {.key = "registration", .help = "How scans are laid on the machine by their marks", .advanced = true},
           {{Registration::kSimilarity, "similarity", "turned, shifted and resized evenly"},
            {Registration::kAffine, "affine", "stretched and sheared as well"}});
  v.integer(p.adaptive_levels, {.key = "adaptiveLevels",
                                .min = 0,
                                .max = 4,
                                .ui_min = 0,
                                .ui_max = 2,
                                .help = "How often a patch may be quartered",
                                .symbol = "n_adaptive"});
  v.number(p.adaptive_factor,
           {.key = "adaptiveFactor",
            .min = 0,
            .max = 100,
            .ui_min = 0.5,
            .ui_max = 2,
            .help = "A patch is quartered where its quarters together cost less than this times its own cost",
            .symbol = "w_adaptive"});
  v.number(p.attraction, {.key = "attraction",
                          .min = 0,
                          .max = 20,
                          .ui_min = 0,
                          .ui_max = 8,
                          .help = "Grid morphed: how strongly edges attract corners, which else lie evenly",
                          .symbol = "w",
                          .advanced = true});
  v.number(p.attraction_mm, {.key = "attractionMm",
                             .min = 0,
                             .max = 500,
                             .ui_min = 0,
                             .ui_max = 20,
                             .unit = "mm",
                             .help = "Grid morphed: how far edges attract corners; 0 takes half of patchMm",
                             .advanced = true});
  v.text(p.pins, {.key = "pins",
                  .help = "Grid morphed: corners laid by hand, column,row:x,y in mm: 3,4:123.5,87.2; 5,4:150,88",
                  .advanced = true});
  v.number(p.overlap_mm,
           {.key = "overlapMm",
            .min = 0,
            .max = 500,
            .ui_min = 0,
            .ui_max = 20,
            .unit = "mm",
            .help = "Seams: how wide pieces may overlap, where there is wood; 0 takes a quarter of patchMm",
            .advanced = true});
  v.number(p.seam_error_mm, {.key = "seamErrorMm",
                             .min = 0.01,
                             .max = 1,
                             .ui_min = 0.02,
                             .ui_max = 0.5,
                             .unit = "mm",
                             .help = "Seams, grid morphed: how far curves may be from what they follow",
                             .advanced = true});
  v.number(p.weight_colour, {.key = "weightColour",
                             .min = 0,
                             .max = 1,
                             .ui_min = 0,
                             .ui_max = 1,
                             .help = "How much hue matters, in Lab; the paper leaves it out",
                             .advanced = true});
  v.number(p.grain_degrees, {.key = "grainDegrees",
                             .min = 0,
                             .max = 180,
                             .ui_min = 0,
                             .ui_max = 90,
                             .unit = "deg",
                             .help = "Grain degrees: how far wood may be turned",
                             .advanced = true});
  v.number(p.resolution_dpi, {.key = "resolutionDpi",
                              .min = 0,
                              .max = 1200,
                              .ui_min = 0,
                              .ui_max = 300,
                              .unit = "dpi",
                              .help = "Resolution of the matching; 0 takes that of the coarsest panel, at most 150",
                              .advanced = true});
}
// clang-format on

// Cross-field checks, after each field is within its own range: report(key, message).
template <class Report>
void check(const Params& p, Report&& report) {
  if (p.patch_mm < p.min_width_mm) report("patchMm", "is less than minWidthMm, expected at least that");
  if (p.patch_mm > p.image_size_mm) report("patchMm", "is more than imageSizeMm, expected at most that");
  if (p.grid == GridKind::kMorphed) {
    if (p.seams != SeamKind::kNone)
      report("seams", "are set where the grid is morphed, expected none: they join patches of a regular grid");
    if (p.adaptive_levels > 0)
      report("adaptiveLevels", "is above 0 where the grid is morphed, expected 0: only rectangles are quartered");
    read_pins(p.pins, [&](const std::string& message) { report("pins", message); });
  } else if (!p.pins.empty()) {
    report("pins", "are set where the grid is regular, expected none, or grid morphed");
  }
  if (p.seams != SeamKind::kNone) {
    if (p.adaptive_levels > 0 && p.grid == GridKind::kRegular)
      report("adaptiveLevels", "is above 0 where there are seams, expected 0: seams join whole patches of the grid");
    if (p.overlap_mm > p.patch_mm - p.min_width_mm)
      report("overlapMm", "is more than patchMm less minWidthMm, expected at most that");
  }
  read_panel_options(p.panels, [&](const std::string& message) { report("panels", message); });
}

}  // namespace tessera::parquetry

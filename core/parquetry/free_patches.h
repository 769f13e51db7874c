// Patches of any shape: of a segmentation that somebody has drawn, or of the target's own tones (3.4, 5).
#pragma once

#include <string>
#include <vector>

#include "tessera/base/status.h"
#include "tessera/image/image_view.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"
#include "tessera/parquetry/regions.h"

namespace tessera::parquetry {

inline constexpr int kMostRegions = 200000;

// The target's regions, and how many of its pixels a pixel of what they were drawn on takes along an axis, >= 1.
struct Segmentation {
  Regions regions;
  double grain = 1;
};

// The connected parts of equal pixels, each pixel of the target taking the nearest of the picture. kInvalidInput for
// `segmentation` where the picture's proportions are not the target's, within a hundredth, or it has more than
// kMostRegions parts.
Result<Segmentation> drawn_regions(const ImageView& picture, cv::Size target);

// The target without details that are narrower than minWidthMm, in as few tones as `posterize` says; connected parts
// of one tone that are longer than largestPatch patches are split.
Segmentation posterized_regions(const cv::Mat3b& target, const Params& params, double mm_per_px);

// What keeps a piece from being cut, or lets it break.
struct Flaw {
  int patch = 0;     // index in the outlines
  std::string what;  // "neck of 2.1 mm"
  Point at;          // px
};

// By patch. Outlines in px; each has a flaw at most.
std::vector<Flaw> flaws_of(const std::vector<Polygon>& outlines, const Params& params, double mm_per_px);

// A patch a region, with smooth outlines, of none of which flaws_of() tells: thinParts says whether regions are made
// wide enough, or are refused (kInvalidInput for `segmentation`, with all flaws). `row` and `column` count bands of
// the picture as high as patchMm that begin patches, from the top, and the patches of a band from the left.
Result<std::vector<Patch>> free_patches(Segmentation segmentation, const Params& params, double mm_per_px,
                                        int target_index = 0);

// What people have drawn over a target; without pixels where they have not.
struct Drawn {
  ImageView segmentation;  // drawn_regions()
  ImageView edge_mask{};   // of a morphed grid: edge_masks_of()
};

// Those of a target at the panels' resolution: of a segmentation if there is one, else of its tones where `posterize`
// is above 0, else of a grid, regular or morphed.
Result<std::vector<Patch>> patches_of(const cv::Mat3b& target, const Drawn& drawn, const Params& params,
                                      double mm_per_px, int target_index = 0);

}  // namespace tessera::parquetry

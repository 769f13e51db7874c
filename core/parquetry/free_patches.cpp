#include "tessera/parquetry/free_patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "tessera/geometry/inscribed.h"
#include "tessera/geometry/narrow.h"
#include "tessera/geometry/scan.h"
#include "tessera/image/zones.h"
#include "tessera/parquetry/morphed_patches.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/spacing.h"
#include "tessera/voronoi/smooth_outlines.h"

namespace tessera::parquetry {
namespace {

// The nearest pixel of `from` for each of `to`.
int nearest(int i, int from, int to) {
  return static_cast<int>((2 * std::int64_t{i} + 1) * from / (2 * std::int64_t{to}));
}

std::optional<Flaw> flaw_of(const Polygon& outline, const Params& params, double mm_per_px) {
  constexpr double kPrecisionMm = 0.01, kRoughMm = 0.03;
  constexpr double kTail = 1.25;  // half widths squared: what is missed in a corner of 44 degrees
  const double width = params.min_width_mm / mm_per_px;
  const Circle room = largest_inscribed(outline, kPrecisionMm / mm_per_px);
  if (2 * room.radius * mm_per_px < params.min_width_mm - 2 * kPrecisionMm)
    return Flaw{0, fmt::format("only {:.1f} mm wide", 2 * room.radius * mm_per_px), room.centre};
  const double precision = fair_precision(outline, kRoughMm / mm_per_px);
  if (const Neck neck = narrowest_neck(outline, width - precision, precision); std::isfinite(neck.width))
    return Flaw{0, fmt::format("a neck of {:.1f} mm", neck.width * mm_per_px), neck.at};
  if (const ThinPart part = largest_thin_part(outline, width, precision); part.area > kTail * width * width / 4)
    return Flaw{0, fmt::format("a thin part of {:.1f} mm2", part.area * mm_per_px * mm_per_px), part.at};
  return std::nullopt;
}

tl::unexpected<Status> refused(const std::vector<Flaw>& flaws, std::size_t regions, const Params& params,
                               double mm_per_px) {
  std::string list;
  for (const Flaw& flaw : flaws)
    list += fmt::format("{}{} at ({:.1f}, {:.1f}) mm", list.empty() ? "" : ", ", flaw.what, flaw.at.x * mm_per_px,
                        flaw.at.y * mm_per_px);
  return fail(StatusCode::kInvalidInput, "segmentation",
              fmt::format("has {} of {} pieces that are too thin: {}; expected {:g} mm everywhere (minWidthMm), or "
                          "thinParts repair",
                          flaws.size(), regions, list, params.min_width_mm));
}

std::vector<Polygon> outlines_of(const Segmentation& segmentation, double width) {
  // Stairs of the drawing's pixels go; where they are as large as pieces they are meant.
  constexpr double kStair = 0.75, kLargest = 1.0 / 6;
  const double tolerance = std::max(kStair, std::min(kStair * segmentation.grain, kLargest * width));
  return smooth_outlines(segmentation.regions.labels, segmentation.regions.count, tolerance);
}

Patch patch_of(Polygon outline, cv::Size target, int target_index) {
  const Bounds box = bounds_of(outline.outer);
  const cv::Point low(static_cast<int>(std::floor(box.low.x)), static_cast<int>(std::floor(box.low.y)));
  const cv::Point high(static_cast<int>(std::ceil(box.high.x)), static_cast<int>(std::ceil(box.high.y)));
  Patch patch;
  patch.target = target_index;
  patch.box = cv::Rect(low, high) & cv::Rect({0, 0}, target);
  patch.mask = cv::Mat1b(patch.box.size(), static_cast<std::uint8_t>(0));
  each_run(outline, target.width, target.height, [&](int y, int begin, int end) {
    patch.mask.row(y - patch.box.y).colRange(begin - patch.box.x, end - patch.box.x).setTo(255);
  });
  patch.outline = std::move(outline);
  return patch;
}

// By the middles of their boxes.
void number(std::vector<Patch>& patches, double band) {
  const auto middle = [](const Patch& patch) {
    return Point{patch.box.x + 0.5 * patch.box.width, patch.box.y + 0.5 * patch.box.height};
  };
  for (Patch& patch : patches) patch.row = static_cast<int>(middle(patch).y / band);
  std::stable_sort(patches.begin(), patches.end(), [&](const Patch& a, const Patch& b) {
    return a.row != b.row ? a.row < b.row : middle(a).x < middle(b).x;
  });
  int row = -1, column = 0, band_of_row = -1;
  for (Patch& patch : patches) {
    if (patch.row != band_of_row) ++row, column = 0, band_of_row = patch.row;
    patch.row = row;
    patch.column = column++;
  }
}

std::vector<char> marked(const std::vector<Flaw>& flaws, int count) {
  std::vector<char> marks(count, 0);
  for (const Flaw& flaw : flaws) marks[flaw.patch] = 1;
  return marks;
}

}  // namespace

Result<Segmentation> drawn_regions(const ImageView& picture, cv::Size target) {
  if (!has_proportions(picture, target))
    return fail(StatusCode::kInvalidInput, "segmentation",
                fmt::format("is {} x {}, expected the target's proportions, {} to {}", picture.width, picture.height,
                            target.width, target.height));
  const cv::Mat3b pixels = picture.mat();
  cv::Mat1i values(target);
  for (int y = 0; y < target.height; ++y) {
    const cv::Vec3b* row = pixels[nearest(y, picture.height, target.height)];
    for (int x = 0; x < target.width; ++x) {
      const cv::Vec3b& pixel = row[nearest(x, picture.width, target.width)];
      values(y, x) = pixel[0] << 16 | pixel[1] << 8 | pixel[2];
    }
  }
  Segmentation segmentation{regions_of(values), std::max(1.0, static_cast<double>(target.width) / picture.width)};
  if (segmentation.regions.count > kMostRegions)
    return fail(StatusCode::kInvalidInput, "segmentation",
                fmt::format("has {} regions, expected at most {}: of one colour or number each, without noise",
                            segmentation.regions.count, kMostRegions));
  return segmentation;
}

Segmentation posterized_regions(const cv::Mat3b& target, const Params& params, double mm_per_px) {
  constexpr int kLargestWindow = 255;
  const int window = std::min(kLargestWindow, static_cast<int>(params.min_width_mm / mm_per_px) | 1);
  cv::Mat3b calm;
  cv::medianBlur(target, calm, window);
  cv::Mat1i tones;
  colour_zones(calm, params.posterize).map.convertTo(tones, CV_32S);
  const Regions wide = widened(regions_of(tones), params.min_width_mm / mm_per_px);
  // The tones' frontiers follow the photo's noise; these lines need not.
  constexpr double kWobble = 1.0 / 9;
  return {split_large(wide, params.largest_patch * params.patch_mm / mm_per_px),
          std::max(1.0, kWobble * params.min_width_mm / mm_per_px)};
}

std::vector<Flaw> flaws_of(const std::vector<Polygon>& outlines, const Params& params, double mm_per_px) {
  std::vector<std::optional<Flaw>> found(outlines.size());
  cv::parallel_for_({0, static_cast<int>(outlines.size())}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) found[i] = flaw_of(outlines[i], params, mm_per_px);
  });
  std::vector<Flaw> flaws;
  for (int i = 0; i < static_cast<int>(found.size()); ++i) {
    if (!found[i]) continue;
    flaws.push_back(*std::move(found[i]));
    flaws.back().patch = i;
  }
  return flaws;
}

Result<std::vector<Patch>> free_patches(Segmentation segmentation, const Params& params, double mm_per_px,
                                        int target_index) {
  const bool repair = params.thin_parts == ThinParts::kRepair;
  const double width = params.min_width_mm / mm_per_px;
  Regions& regions = segmentation.regions;
  if (repair) regions = widened(std::move(regions), width);
  // Smooth lines are not those between pixels: a little more room, and in the end fewer pieces, until all are wide.
  constexpr int kRounds = 3;
  std::vector<Polygon> outlines;
  for (int round = 1;; ++round) {
    if (params.enclosed == Enclosed::kSplit && round <= kRounds) regions = without_holes(std::move(regions));
    part_corners(regions.labels);
    regions = regions_of(regions.labels);
    outlines = outlines_of(segmentation, width);
    const std::vector<Flaw> flaws = flaws_of(outlines, params, mm_per_px);
    if (flaws.empty() || (repair && regions.count == 1)) break;
    if (!repair) return refused(flaws, outlines.size(), params, mm_per_px);
    regions = round <= kRounds ? widened(std::move(regions), width + 2 * round)
                               : joined(regions, marked(flaws, regions.count));
  }
  std::vector<Patch> patches;
  for (Polygon& outline : outlines)
    patches.push_back(patch_of(std::move(outline), regions.labels.size(), target_index));
  number(patches, params.patch_mm / mm_per_px);
  return patches;
}

Result<std::vector<Patch>> patches_of(const cv::Mat3b& target, const Drawn& drawn, const Params& params,
                                      double mm_per_px, int target_index) {
  if (drawn.segmentation.pixels) {
    auto regions = drawn_regions(drawn.segmentation, target.size());
    if (!regions) return tl::unexpected<Status>(std::move(regions.error()));
    return free_patches(*std::move(regions), params, mm_per_px, target_index);
  }
  if (params.posterize > 0)
    return free_patches(posterized_regions(target, params, mm_per_px), params, mm_per_px, target_index);
  if (params.grid == GridKind::kMorphed) {
    const auto masks = edge_masks_of(drawn.edge_mask, target.size());
    if (!masks) return tl::unexpected<Status>(masks.error());
    return morphed_patches(target, params, mm_per_px, *masks, target_index);
  }
  return grid_patches(target.size(), params, mm_per_px, target_index);
}

}  // namespace tessera::parquetry

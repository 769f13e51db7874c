#include "tessera/pebbles/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "tessera/image/resample.h"
#include "tessera/pebbles/edits.h"
#include "tessera/pebbles/outlines.h"
#include "tessera/pebbles/scene.h"
#include "tessera/pebbles/segment_rays.h"
#include "tessera/pebbles/segment_tree.h"

namespace tessera::pebbles {
namespace {

// Somebody else's label picture: any number a pebble, 0 the ground; in the photo's size.
Result<cv::Mat1i> given_labels(const Pictures& pictures) {
  const ImageView& given = pictures.segmentation;
  if (!given.pixels)
    return fail(StatusCode::kInvalidInput, "segmentation",
                "is missing, expected a label picture for segmenter labels");
  if (given.width != pictures.photo.width || given.height != pictures.photo.height)
    return fail(StatusCode::kInvalidInput, "segmentation",
                fmt::format("is {} x {} px, expected the photo's {} x {}", given.width, given.height,
                            pictures.photo.width, pictures.photo.height));
  cv::Mat1i labels(given.height, given.width);
  const cv::Mat3b numbers = given.mat();
  std::unordered_map<int, int> label_of{{0, 0}};
  std::transform(numbers.begin(), numbers.end(), labels.begin(), [&](const cv::Vec3b& v) {
    return label_of.try_emplace(v[0] << 16 | v[1] << 8 | v[2], static_cast<int>(label_of.size())).first->second;
  });
  return labels;
}

// 3.1, 3.2: the mask and its slices.
Result<cv::Mat1i> segment(const Pictures& pictures, const Params& params, const RunContext& context) {
  if (params.segmenter == Segmenter::kLabels) return given_labels(pictures);
  const cv::Mat3b searched = shrunk(pictures.photo, params.width);
  return params.segmenter == Segmenter::kRays ? segment_by_rays(searched, params, context)
                                              : segment_by_tree(searched, params, context);
}

// Row by row of `height` pixels, from left to right in each; ids from 1.
void put_in_reading_order(double height, std::vector<Pebble>& pebbles) {
  const auto row = [&](const Pebble& p) { return std::floor(p.centre.y / height); };
  std::stable_sort(pebbles.begin(), pebbles.end(), [&](const Pebble& a, const Pebble& b) {
    return row(a) != row(b) ? row(a) < row(b) : a.centre.x < b.centre.x;
  });
  for (std::size_t k = 0; k < pebbles.size(); ++k) pebbles[k].id = static_cast<int>(k) + 1;
}

// The outlines as pieces, each of the mean colour of its pixels.
PieceSheet sheet_of(const ImageView& photo, const cv::Mat1i& labels, const std::vector<Pebble>& pebbles,
                    double width_mm) {
  struct Sum {
    std::int64_t count = 0, r = 0, g = 0, b = 0;
    Rgb mean() const {
      const auto part = [this](std::int64_t sum) {
        return static_cast<std::uint8_t>(count > 0 ? (2 * sum + count) / (2 * count) : 128);
      };
      return {part(r), part(g), part(b)};
    }
  };
  std::vector<Sum> sums(pebbles.size() + 1);
  const cv::Mat3b pixels = photo.mat();
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      Sum& sum = sums[labels(y, x)];
      const cv::Vec3b& pixel = pixels(y, x);
      ++sum.count, sum.r += pixel[0], sum.g += pixel[1], sum.b += pixel[2];
    }
  PieceSheet sheet;
  sheet.kind = "pebble";
  sheet.layer = "pebbles";
  sheet.width = photo.width;
  sheet.height = photo.height;
  sheet.width_mm = width_mm;
  sheet.grout = sums[0].mean();
  for (const Pebble& pebble : pebbles)
    sheet.pieces.push_back({pebble.id, {outline(pebble), {}}, sums[pebble.id].mean()});
  return sheet;
}

}  // namespace

Result<Output> run(const Pictures& pictures, const Params& params, std::uint64_t seed, const RunContext& context) {
  const ImageView& photo = pictures.photo;
  if (photo.width < 1 || photo.height < 1)
    return fail(StatusCode::kInvalidInput, "photo", "has no pixels; expected at least 1 x 1");

  context.stage("segment");
  Result<cv::Mat1i> found = segment(pictures, params, context);
  if (!found) return tl::unexpected(found.error());
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  context.progress(0.6);

  context.stage("outlines");
  const double scale = static_cast<double>(found->cols) / photo.width;
  std::vector<Edit> edits;
  parse_edits(params.edits, edits);
  const int made = apply_edits(edits, scale, *found);
  if (made < static_cast<int>(edits.size()))
    context.warn(fmt::format("{} of {} edits hit no pebble", edits.size() - made, edits.size()));
  Output output;
  output.pebbles = fit_outlines(*found);
  enlarge(1 / scale, output.pebbles);
  put_in_reading_order(photo.height / 20.0, output.pebbles);
  output.labels = paint_labels(output.pebbles, {photo.width, photo.height});
  if (output.pebbles.empty())
    context.warn("found no pebbles; expected a photo from above of stones that stand out from what is around them");
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  context.progress(0.7);

  context.stage("grains");
  output.grains = measure_grains(output.pebbles);
  output.metres_per_px = metres_per_pixel(params, photo.width);
  output.sheet = sheet_of(photo, output.labels, output.pebbles, 1000 * output.metres_per_px * photo.width);
  context.stage("meshes");
  output.scene = build_scene(output.pebbles, output.labels, photo, params, seed);
  context.progress(1);
  return output;
}

}  // namespace tessera::pebbles

#include "tessera/mosaic/colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core/utility.hpp>

#include "tessera/base/colour.h"
#include "tessera/geometry/scan.h"
#include "tessera/image/palette.h"
#include "tessera/mosaic/tile_palette.h"

namespace tessera::mosaic {
namespace {

std::uint8_t level_of(double light) {
  const auto& table = linear_light();
  const auto above = std::lower_bound(table.begin(), table.end(), light);
  if (above == table.begin()) return 0;
  if (above == table.end()) return 255;
  const auto below = above - 1;
  return static_cast<std::uint8_t>((*above - light < light - *below ? above : below) - table.begin());
}

Rgb pixel_at(const ImageView& photo, Point p) {
  const int x = std::clamp(static_cast<int>(p.x), 0, photo.width - 1),
            y = std::clamp(static_cast<int>(p.y), 0, photo.height - 1);
  const std::uint8_t* pixel = photo.pixels + y * photo.stride + 3 * static_cast<std::ptrdiff_t>(x);
  return {pixel[0], pixel[1], pixel[2]};
}

Rgb mean_under(const ImageView& photo, const Ring& ring) {
  const auto& light = linear_light();
  std::uint64_t sum[3] = {0, 0, 0}, count = 0;
  each_run(ring, photo.width, photo.height, [&](int y, int begin, int end) {
    const std::uint8_t* pixel = photo.pixels + y * photo.stride + 3 * static_cast<std::ptrdiff_t>(begin);
    for (int x = begin; x < end; ++x, pixel += 3)
      for (int c = 0; c < 3; ++c) sum[c] += light[pixel[c]];
    count += static_cast<std::uint64_t>(end - begin);
  });
  if (count == 0) return pixel_at(photo, centroid(ring));
  const auto level = [&](int c) { return level_of(static_cast<double>(sum[c]) / static_cast<double>(count)); };
  return {level(0), level(1), level(2)};
}

}  // namespace

std::vector<Rgb> tile_colours(const ImageView& photo, const std::vector<Ring>& rings, Sample sample) {
  std::vector<Rgb> colours(rings.size());
  cv::parallel_for_({0, static_cast<int>(rings.size())}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      if (rings[i].empty()) continue;
      colours[i] = sample == Sample::kMean ? mean_under(photo, rings[i]) : pixel_at(photo, centroid(rings[i]));
    }
  });
  return colours;
}

std::vector<Material> limit_colours(const std::string& palette, std::vector<Rgb>& colours) {
  TilePalette given;
  if (colours.empty() || !parse_palette(palette, given)) return {};
  if (given.count == 0 && given.materials.empty()) return {};
  const cv::Mat1f lab = to_lab(colours);
  cv::Mat1f centres;
  if (given.count > 0) {
    centres = lab_palette(lab, given.count);
    for (const Rgb colour : to_rgb(centres)) given.materials.push_back({"", colour});
  } else {
    std::vector<Rgb> list;
    for (const Material& material : given.materials) list.push_back(material.colour);
    centres = to_lab(list);
  }
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const int row = static_cast<int>(i);
    colours[i] = given.materials[nearest_colour(centres, {lab(row, 0), lab(row, 1), lab(row, 2)})].colour;
  }
  return given.materials;
}

}  // namespace tessera::mosaic

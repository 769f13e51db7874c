#include "tessera/mosaic/regions.h"

#include <algorithm>

#include "tessera/base/text.h"

namespace tessera::mosaic {

bool parse_region_sizes(const std::string& text, std::vector<RegionSize>& sizes) {
  sizes.clear();
  for (const std::string_view word : split(text, " ,;\n\t\r")) {
    const std::size_t equals = word.find('=');
    RegionSize entry;
    if (equals == std::string_view::npos || !parse_colour(word.substr(0, equals), entry.colour)) return false;
    if (!parse_number(word.substr(equals + 1), entry.size) || !(entry.size >= 0.05 && entry.size <= 20)) return false;
    sizes.push_back(entry);
  }
  return !sizes.empty();
}

cv::Mat1f region_sizes(const cv::Mat3b& regions, const std::string& text, cv::Size nodes, double step) {
  std::vector<RegionSize> sizes;
  cv::Mat1f map(nodes, 1.0f);
  if (!parse_region_sizes(text, sizes)) return map;
  for (int j = 0; j < nodes.height; ++j)
    for (int i = 0; i < nodes.width; ++i) {
      const cv::Vec3b c = regions(std::min(regions.rows - 1, static_cast<int>(j * step)),
                                  std::min(regions.cols - 1, static_cast<int>(i * step)));
      const auto off = [&](const RegionSize& s) {
        const int r = c[0] - s.colour.r, g = c[1] - s.colour.g, b = c[2] - s.colour.b;
        return r * r + g * g + b * b;
      };
      map(j, i) = static_cast<float>(
          std::min_element(sizes.begin(), sizes.end(), [&](const RegionSize& a, const RegionSize& b) {
            return off(a) < off(b);
          })->size);
    }
  return map;
}

}  // namespace tessera::mosaic

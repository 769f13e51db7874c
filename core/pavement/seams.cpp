#include "tessera/pavement/seams.h"

namespace tessera::pavement {
namespace {

Point as_point(cv::Point p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

}  // namespace

std::vector<cv::Point> first_pixels(const Diagram& diagram, cv::Point origin) {
  std::vector<cv::Point> first(diagram.cells, {-1, -1});
  for (int y = 0; y < diagram.labels.rows; ++y) {
    const int* row = diagram.labels[y];
    for (int x = 0; x < diagram.labels.cols; ++x)
      if ((x == 0 || row[x] != row[x - 1]) && first[row[x]].x < 0) first[row[x]] = origin + cv::Point(x, y);
  }
  return first;
}

void Seams::keep(cv::Point first_pixel, const Tessellation& placed, const Tessellation& laid,
                 const std::vector<char>& flat, int cell, cv::Point origin) {
  std::vector<Corner>& corners = cells_[{first_pixel.y, first_pixel.x}];
  corners.clear();
  for (int slot = placed.map.first[cell]; slot < placed.map.first[cell + 1]; ++slot)
    corners.push_back({placed.map.at(slot) + as_point(origin), laid.map.at(slot) + as_point(origin), flat[slot]});
}

std::vector<Pin> Seams::adopt(const std::vector<cv::Point>& first_pixels, cv::Point origin,
                              const Tessellation& placed, std::vector<char>& flat) const {
  constexpr double kSamePlace = 1e-6;  // px
  const PlanarMap& map = placed.map;
  const Point begin = as_point(origin);
  std::vector<Pin> pins;
  std::vector<int> owner(map.vertices.size(), -1);  // the remembered slot where it is flat
  for (int cell = 0; cell < map.cells(); ++cell) {
    const auto found = cells_.find({first_pixels[cell].y, first_pixels[cell].x});
    const int first = map.first[cell];
    if (found == cells_.end() || static_cast<int>(found->second.size()) != map.corners(cell)) continue;
    for (int slot = first; slot < map.first[cell + 1]; ++slot) {
      const Corner& corner = found->second[slot - first];
      if (length(map.at(slot) + begin - corner.placed) > kSamePlace) continue;
      pins.push_back({map.ring[slot], corner.laid - begin});
      flat[slot] = corner.flat;
      if (corner.flat) owner[map.ring[slot]] = slot;
    }
  }
  for (int slot = 0; slot < static_cast<int>(flat.size()); ++slot) {
    const int held = owner[map.ring[slot]];
    if (held >= 0 && held != slot) flat[slot] = 0;
  }
  return pins;
}

void Seams::forget_above(int row) { cells_.erase(cells_.begin(), cells_.lower_bound({row, 0})); }

}  // namespace tessera::pavement

#include "tessera/parquetry/pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/inscribed.h"
#include "tessera/geometry/narrow.h"
#include "tessera/geometry/scan.h"

namespace tessera::parquetry {
namespace {

// Along which way brightness changes least: across the main axis of the gradients (structure tensor).
double grain_of(const cv::Mat1b& grey, const Polygon& outline) {
  std::int64_t difference = 0, product = 0;  // sums of gx^2 - gy^2 and of 2 gx gy
  each_run(outline, grey.cols, grey.rows, [&](int y, int begin, int end) {
    if (y < 1 || y + 1 >= grey.rows) return;
    for (int x = std::max(begin, 1); x < std::min(end, grey.cols - 1); ++x) {
      const std::int64_t gx = grey(y, x + 1) - grey(y, x - 1), gy = grey(y + 1, x) - grey(y - 1, x);
      difference += gx * gx - gy * gy;
      product += 2 * gx * gy;
    }
  });
  return 90 + atan2_portable(static_cast<double>(product), static_cast<double>(difference)) * 90 / kPi;
}

// All in mm.
double least_width(const Polygon& outline, double necks_below) {
  constexpr double kPrecision = 0.01, kNeckPrecision = 0.03;
  return std::min(2 * largest_inscribed(outline, kPrecision).radius,
                  narrowest_neck(outline, necks_below, fair_precision(outline, kNeckPrecision)).width);
}

Polygon scaled(const Polygon& outline, double scale) {
  Polygon result = outline;
  for (Point& p : result.outer) p = scale * p;
  for (Ring& hole : result.holes)
    for (Point& p : hole) p = scale * p;
  return result;
}

}  // namespace

std::string column_letters(int column) {
  std::string letters;
  for (int rest = column + 1; rest > 0; rest = (rest - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('A' + (rest - 1) % 26));
  return letters;
}

// Its place, and a letter where it shares that with others.
std::vector<std::string> names_of(const std::vector<Patch>& patches) {
  std::map<std::tuple<int, int, int>, int> shares, seen;
  int targets = 1;
  for (const Patch& patch : patches) {
    ++shares[{patch.target, patch.row, patch.column}];
    targets = std::max(targets, patch.target + 1);
  }
  std::vector<std::string> names;
  for (const Patch& patch : patches) {
    const std::tuple place{patch.target, patch.row, patch.column};
    std::string name = targets > 1 ? std::to_string(patch.target + 1) + "-" : "";
    name += column_letters(patch.column) + std::to_string(patch.row + 1);
    if (shares[place] > 1) {
      std::string part = column_letters(seen[place]++);
      for (char& c : part) c = static_cast<char>(c - 'A' + 'a');
      name += part;
    }
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<CutPiece> pieces_of(const std::vector<Panel>& panels, const std::vector<Patch>& patches,
                                const std::vector<Placement>& placements, const Params& params) {
  std::vector<cv::Mat1b> greys(panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) cv::cvtColor(panels[i].scan, greys[i], cv::COLOR_RGB2GRAY);
  std::vector<const Placement*> placed(patches.size(), nullptr);
  for (const Placement& placement : placements)
    if (placement.panel >= 0) placed[static_cast<std::size_t>(placement.patch)] = &placement;
  const std::vector<std::string> names = names_of(patches);
  std::vector<CutPiece> pieces;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!placed[i]) continue;
    const Placement& placement = *placed[i];
    CutPiece piece{.id = names[i],
                   .row = patches[i].row + 1,
                   .column = patches[i].column + 1,
                   .target = patches[i].target + 1,
                   .panel = static_cast<std::size_t>(placement.panel),
                   .on_panel = on_panel(placement, patches[i].outline),
                   .finished = patches[i].outline,
                   .turn_deg = placement.turn_deg,
                   .cost = placement.cost};
    const double mm = panels[piece.panel].mm_per_px;
    piece.centroid_mm = mm * centroid_with_holes(piece.on_panel);
    piece.area_mm2 = mm * mm * area(piece.on_panel);
    piece.min_width_mm = least_width(scaled(piece.on_panel, mm), params.min_width_mm);
    const double grain = grain_of(greys[piece.panel], piece.on_panel) + piece.turn_deg;
    piece.grain_deg = grain - 180 * std::floor(grain / 180);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

std::vector<MissingPiece> missing_of(const std::vector<Patch>& patches, const std::vector<Placement>& placements) {
  const std::vector<std::string> names = names_of(patches);
  std::vector<MissingPiece> missing;
  for (const Placement& placement : placements) {
    if (placement.panel >= 0) continue;
    const auto i = static_cast<std::size_t>(placement.patch);
    missing.push_back({names[i], patches[i].target + 1, patches[i].outline});
  }
  return missing;
}

std::vector<int> side_by_side(const std::vector<cv::Size>& targets) {
  std::vector<int> edges = {0};
  for (const cv::Size& target : targets) edges.push_back(edges.back() + target.width);
  return edges;
}

}  // namespace tessera::parquetry

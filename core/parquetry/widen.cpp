#include "tessera/parquetry/widen.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace tessera::parquetry {
namespace {

constexpr double kCorner = 1.05;  // squared radii: what a disc leaves of a corner of 49 degrees; curves may take more
constexpr int kAround = 2;        // px

// Piece (column, row) in a frame of a pixel; `corner` becomes where the frame's first pixel is on the target.
cv::Mat1b mask_of(const Grid& grid, const Seams& seams, int stray, int column, int row, cv::Point& corner) {
  const cv::Rect wider = grid.around(column, row, stray);
  corner = wider.tl() - cv::Point(1, 1);
  cv::Mat1b mask(wider.height + 2, wider.width + 2, static_cast<std::uint8_t>(0));
  for (int y = wider.y; y < wider.y + wider.height; ++y)
    for (int x = std::max(wider.x, seams.columns[column][y]);
         x < std::min(wider.x + wider.width, seams.columns[column + 1][y]); ++x)
      if (seams.rows[row][x] <= y && y < seams.rows[row + 1][x]) mask(y - corner.y, x - corner.x) = 255;
  return mask;
}

cv::Mat1f distance_to_zero(const cv::Mat1b& mask) {
  cv::Mat1f distance;
  cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

// Where a piece's pixels are that it may not have, and all beyond them as seen from its cell, where the seam is that
// gave them; places are seen from `corner`, as the piece's mask is.
void add_places_not_free(const cv::Mat1b& mask, const Reconstruction::Piece& piece, cv::Rect cell, cv::Point corner,
                         std::vector<cv::Rect>& places) {
  if (piece.free.empty()) return;
  cv::Mat1b wrong = mask.clone();
  const cv::Rect both = piece.box & cv::Rect(corner, mask.size());
  wrong(both - corner) &= ~piece.free(both - piece.box.tl());
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int parts = cv::connectedComponentsWithStats(wrong, labels, stats, centres, 8);
  for (int part = 1; part < parts; ++part) {
    const int* of = stats.ptr<int>(part);
    cv::Point first(of[cv::CC_STAT_LEFT], of[cv::CC_STAT_TOP]);
    cv::Point last = first + cv::Point(of[cv::CC_STAT_WIDTH], of[cv::CC_STAT_HEIGHT]);
    if (corner.x + first.x < cell.x) first.x = 0;
    if (corner.y + first.y < cell.y) first.y = 0;
    if (corner.x + last.x > cell.br().x) last.x = mask.cols;
    if (corner.y + last.y > cell.br().y) last.y = mask.rows;
    places.emplace_back(first, last);
  }
}

bool straighten_around(const Grid& grid, int column, int row, cv::Rect place, Seams& seams) {
  const cv::Range x(place.x - kAround, place.x + place.width + kAround),
      y(place.y - kAround, place.y + place.height + kAround);
  bool moved = false;
  for (const int c : {column, column + 1})
    if (c > 0 && c < grid.across()) moved |= straighten(seams.columns[c], grid.columns[c], y, x);
  for (const int r : {row, row + 1})
    if (r > 0 && r < grid.down()) moved |= straighten(seams.rows[r], grid.rows[r], x, y);
  return moved;
}

}  // namespace

std::vector<cv::Rect> narrow_places(const cv::Mat1b& piece, double width) {
  const double radius = 0.5 * width;
  const cv::Rect whole({0, 0}, piece.size());
  // Where middles of discs have room, a pixel generously.
  const cv::Mat1b middles = distance_to_zero(piece) > radius - 0.5;
  cv::Mat1i labels;
  if (cv::connectedComponents(middles, labels, 8) != 2) return {whole};
  cv::Mat1b missed = distance_to_zero(~middles) > radius;
  missed &= piece;
  cv::Mat stats, centres;
  const int parts = cv::connectedComponentsWithStats(missed, labels, stats, centres, 4);
  std::vector<cv::Rect> places;
  for (int part = 1; part < parts; ++part) {
    const int* of = stats.ptr<int>(part);
    if (of[cv::CC_STAT_AREA] > kCorner * radius * radius)
      places.emplace_back(of[cv::CC_STAT_LEFT], of[cv::CC_STAT_TOP], of[cv::CC_STAT_WIDTH], of[cv::CC_STAT_HEIGHT]);
  }
  return places;
}

bool straighten(Seam& seam, int line, cv::Range rows, cv::Range places) {
  const int length = static_cast<int>(seam.size());
  constexpr int kFree = std::numeric_limits<int>::max() / 2;
  std::vector<int> limits(length, kFree);
  const int first = std::max(0, rows.start), end = std::min(length, rows.end);
  int farthest = 0;
  for (int k = first; k < end; ++k)
    if (places.start <= seam[k] && seam[k] < places.end) farthest = std::max(farthest, std::abs(seam[k] - line));
  const int limit = 7 * farthest / 8;
  for (int k = first; k < end; ++k)
    if (places.start <= seam[k] && seam[k] < places.end) limits[k] = limit;
  for (int k = 1; k < length; ++k) limits[k] = std::min(limits[k], limits[k - 1] + 1);
  for (int k = length - 1; k-- > 0;) limits[k] = std::min(limits[k], limits[k + 1] + 1);
  bool moved = false;
  for (int k = 0; k < length; ++k) {
    const int place = line + std::clamp(seam[k] - line, -limits[k], limits[k]);
    moved |= place != seam[k];
    seam[k] = place;
  }
  return moved;
}

void widen(const Reconstruction& reconstruction, int stray, double width, Seams& seams) {
  const Grid& grid = reconstruction.grid;
  std::vector<bool> unsure(static_cast<std::size_t>(grid.across()) * grid.down(), stray > 0);
  // Each time it lessens what is too much, or finds nothing to do.
  for (bool moved = true; moved;) {
    moved = false;
    std::vector<std::vector<cv::Rect>> narrow(unsure.size());
    cv::parallel_for_({0, static_cast<int>(unsure.size())}, [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i) {
        if (!unsure[i]) continue;
        cv::Point corner;
        const int column = i % grid.across(), row = i / grid.across();
        const cv::Mat1b mask = mask_of(grid, seams, stray, column, row, corner);
        narrow[i] = narrow_places(mask, width);
        add_places_not_free(mask, reconstruction.pieces[i], grid.cell(column, row), corner, narrow[i]);
        for (cv::Rect& place : narrow[i]) place += corner;
      }
    });
    std::fill(unsure.begin(), unsure.end(), false);
    for (int row = 0; row < grid.down(); ++row)
      for (int column = 0; column < grid.across(); ++column)
        for (const cv::Rect place : narrow[row * grid.across() + column]) {
          if (!straighten_around(grid, column, row, place, seams)) continue;
          moved = true;
          for (int r = std::max(0, row - 1); r < std::min(grid.down(), row + 2); ++r)
            for (int c = std::max(0, column - 1); c < std::min(grid.across(), column + 2); ++c)
              unsure[r * grid.across() + c] = true;
        }
  }
}

double share_moved(const Seams& before, const Seams& after) {
  std::int64_t moved = 0, all = 0;
  const auto count = [&](const std::vector<Seam>& a, const std::vector<Seam>& b) {
    for (std::size_t line = 1; line + 1 < a.size(); ++line)
      for (std::size_t k = 0; k < a[line].size(); ++k, ++all) moved += a[line][k] != b[line][k];
  };
  count(before.columns, after.columns);
  count(before.rows, after.rows);
  return all > 0 ? static_cast<double>(moved) / static_cast<double>(all) : 0;
}

}  // namespace tessera::parquetry

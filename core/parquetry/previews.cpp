#include "tessera/parquetry/previews.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tessera/geometry/angle.h"
#include "tessera/geometry/scan.h"

namespace tessera::parquetry {
namespace {

constexpr std::uint8_t kMissing = 160;

Raster raster_of(const cv::Mat3b& picture) {
  Raster raster{picture.cols, picture.rows};
  raster.bytes.assign(picture.ptr(), picture.ptr() + 3 * picture.total());
  return raster;
}

// Between the four pixels around it, in 256ths of one.
cv::Vec3b sample(const cv::Mat3b& scan, Point at) {
  const auto fixed = [](double v, int size) {
    return static_cast<int>(std::lround(256 * std::clamp(v - 0.5, 0.0, size - 1.0)));
  };
  const int x = fixed(at.x, scan.cols), y = fixed(at.y, scan.rows);
  const int left = x >> 8, top = y >> 8, right = std::min(left + 1, scan.cols - 1),
            bottom = std::min(top + 1, scan.rows - 1);
  const int fx = x & 255, fy = y & 255;
  cv::Vec3b result;
  for (int c = 0; c < 3; ++c) {
    const int above = scan(top, left)[c] * (256 - fx) + scan(top, right)[c] * fx;
    const int below = scan(bottom, left)[c] * (256 - fx) + scan(bottom, right)[c] * fx;
    result[c] = static_cast<std::uint8_t>((above * (256 - fy) + below * fy + 32768) >> 16);
  }
  return result;
}

}  // namespace

Raster finished_preview(const std::vector<Panel>& panels, const std::vector<CutPiece>& pieces, int target,
                        cv::Size size) {
  cv::Mat3b picture(size, cv::Vec3b(kMissing, kMissing, kMissing));
  for (const CutPiece& piece : pieces) {
    if (piece.target != target) continue;
    const cv::Mat3b& scan = panels[piece.panel].scan;
    const Angle angle = Angle::of_degrees(piece.turn_deg);
    const Point from = piece.finished.outer.front(), to = piece.on_panel.outer.front();
    each_run(piece.finished, size.width, size.height, [&](int y, int begin, int end) {
      for (int x = begin; x < end; ++x)
        picture(y, x) = sample(scan, to + angle.turned_back(Point{x + 0.5, y + 0.5} - from));
    });
  }
  return raster_of(picture);
}

Raster panel_preview(const std::vector<Panel>& panels, std::size_t panel, const std::vector<CutPiece>& pieces) {
  const Panel& wood = panels[panel];
  cv::Mat3b picture = wood.scan.clone();
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (!wood.mask(y, x))
        for (int c = 0; c < 3; ++c) picture(y, x)[c] = static_cast<std::uint8_t>((picture(y, x)[c] + 2 * 255) / 3);
  constexpr int kShift = 4;  // 16ths of a pixel
  for (const CutPiece& piece : pieces) {
    if (piece.panel != panel) continue;
    std::vector<std::vector<cv::Point>> lines;
    const auto append = [&](const Ring& ring) {
      auto& line = lines.emplace_back();
      for (const Point p : ring)
        line.emplace_back(static_cast<int>(std::lround((p.x - 0.5) * (1 << kShift))),
                          static_cast<int>(std::lround((p.y - 0.5) * (1 << kShift))));
    };
    append(piece.on_panel.outer);
    for (const Ring& hole : piece.on_panel.holes) append(hole);
    cv::polylines(picture, lines, true, {255, 0, 0}, 1, cv::LINE_AA, kShift);
  }
  return raster_of(picture);
}

}  // namespace tessera::parquetry

#include "tessera/pebbles/overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace tessera::pebbles {
namespace {

constexpr int kFraction = 4;  // bits of a coordinate below the pixel

std::vector<cv::Point> corners(const Pebble& pebble) {
  std::vector<cv::Point> points;
  for (const Point p : outline(pebble))
    points.emplace_back(static_cast<int>(std::lround((p.x - 0.5) * (1 << kFraction))),
                        static_cast<int>(std::lround((p.y - 0.5) * (1 << kFraction))));
  return points;
}

}  // namespace

Raster overlay(const cv::Mat3b& photo, const std::vector<Pebble>& pebbles) {
  Raster raster{photo.cols, photo.rows, 3, 8, {}};
  raster.bytes.resize(3 * photo.total());
  cv::Mat3b picture(photo.rows, photo.cols, reinterpret_cast<cv::Vec3b*>(raster.bytes.data()));
  photo.copyTo(picture);
  const int thickness = std::max(1, photo.cols / 900);
  for (const Pebble& pebble : pebbles) {
    const std::vector<std::vector<cv::Point>> line{corners(pebble)};
    cv::polylines(picture, line, true, {20, 20, 20}, 3 * thickness, cv::LINE_AA, kFraction);
    cv::polylines(picture, line, true, {255, 214, 64}, thickness, cv::LINE_AA, kFraction);
  }
  return raster;
}

}  // namespace tessera::pebbles

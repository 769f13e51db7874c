#include "tessera/parquetry/wood_mask.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace tessera::parquetry {
namespace {

constexpr double kWindowMm = 0.8;     // over which a place is even
constexpr double kSafetyMm = 0.3;     // kept from the lid
constexpr double kLeastHoleMm2 = 1;   // smaller even places are grain
constexpr double kLeastCrumbMm = 5;   // a piece could not be smaller
constexpr double kBorderShare = 0.1;  // of the scan's border that a lid covers at least

// Means and deviations of a scan over windows.
struct Evenness {
  int window;           // px, odd
  cv::Mat3b mean;       // a channel
  cv::Mat1b deviation;  // of brightness, rounded up
};

Evenness evenness_of(const cv::Mat3b& rgb, double mm_per_px) {
  Evenness even;
  even.window = 2 * std::max(1, static_cast<int>(std::lround(kWindowMm / mm_per_px / 2))) + 1;
  const cv::Size size(even.window, even.window);
  cv::boxFilter(rgb, even.mean, CV_8U, size, {-1, -1}, true, cv::BORDER_REPLICATE);
  cv::Mat1b grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  cv::Mat1i sum, squares;
  cv::boxFilter(grey, sum, CV_32S, size, {-1, -1}, false, cv::BORDER_REPLICATE);
  cv::sqrBoxFilter(grey, squares, CV_32S, size, {-1, -1}, false, cv::BORDER_REPLICATE);
  const std::int64_t n = std::int64_t{even.window} * even.window;
  even.deviation.create(rgb.size());
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const std::int64_t variance = n * squares(y, x) - std::int64_t{sum(y, x)} * sum(y, x);  // times n^2
      int deviation = 0;
      while (deviation < 255 && n * n * deviation * deviation < variance) ++deviation;
      even.deviation(y, x) = static_cast<std::uint8_t>(deviation);
    }
  return even;
}

// The value that a share of them does not exceed.
int quantile(std::vector<int>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<int> border_deviations(const cv::Mat1b& deviation) {
  std::vector<int> values;
  for (int x = 0; x < deviation.cols; ++x) {
    values.push_back(deviation(0, x));
    values.push_back(deviation(deviation.rows - 1, x));
  }
  for (int y = 0; y < deviation.rows; ++y) {
    values.push_back(deviation(y, 0));
    values.push_back(deviation(y, deviation.cols - 1));
  }
  return values;
}

int distance(cv::Vec3b a, cv::Vec3b b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

// Connected even places; labels as cv::connectedComponents has them.
struct Places {
  cv::Mat1i labels;
  cv::Mat1i stats;
  int count = 0;
};

Places connected(const cv::Mat1b& mask) {
  Places places;
  cv::Mat centroids;
  places.count = cv::connectedComponentsWithStats(mask, places.labels, places.stats, centroids, 4, CV_32S);
  return places;
}

// How far means are from those of a wide neighbourhood of the same place: half of them at least are nearer.
int unevenness(const cv::Mat3b& mean, const cv::Mat1b& place, double mm_per_px) {
  const int wide = 2 * std::max(4, static_cast<int>(std::lround(3 / mm_per_px))) + 1;
  cv::Mat1b grey;
  cv::cvtColor(mean, grey, cv::COLOR_RGB2GRAY);
  cv::Mat1i weight, sum;
  cv::Mat1b ones = place / 255, masked;
  grey.copyTo(masked, place);
  cv::boxFilter(ones, weight, CV_32S, {wide, wide}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(masked, sum, CV_32S, {wide, wide}, {-1, -1}, false, cv::BORDER_CONSTANT);
  std::vector<int> tenths;
  for (int y = 0; y < place.rows; ++y)
    for (int x = 0; x < place.cols; ++x)
      if (place(y, x)) tenths.push_back(std::abs(10 * grey(y, x) - 10 * sum(y, x) / weight(y, x)));
  return tenths.empty() ? 255 : quantile(tenths, 0.8);
}

// The lid around the wood, with room for half a window beside it; empty where there is none.
cv::Mat1b find_lid(const Evenness& even, int noise, double mm_per_px) {
  const cv::Mat1b flat = even.deviation <= 2 * noise + 1;
  const Places places = connected(flat);
  std::vector<int> on_border(static_cast<std::size_t>(places.count), 0);
  const auto count = [&](int y, int x) { ++on_border[static_cast<std::size_t>(places.labels(y, x))]; };
  for (int x = 0; x < flat.cols; ++x) count(0, x), count(flat.rows - 1, x);
  for (int y = 0; y < flat.rows; ++y) count(y, 0), count(y, flat.cols - 1);
  const int border = 2 * (flat.cols + flat.rows);
  cv::Mat1b lid(flat.size(), 0);
  int covered = 0;
  for (int y = 0; y < flat.rows; ++y)
    for (int x = 0; x < flat.cols; ++x) {
      const int label = places.labels(y, x);
      if (label > 0 && on_border[static_cast<std::size_t>(label)] > 0.01 * border) lid(y, x) = 255;
    }
  for (int label = 1; label < places.count; ++label)
    if (on_border[static_cast<std::size_t>(label)] > 0.01 * border)
      covered += on_border[static_cast<std::size_t>(label)];
  const bool enough = covered >= kBorderShare * border;
  const int most_tenths = 10 + 5 * noise;
  return enough && unevenness(even.mean, lid, mm_per_px) <= most_tenths ? lid : cv::Mat1b();
}

// Even places of the lid's colour that the wood surrounds.
void add_holes(const Evenness& even, int noise, double mm_per_px, cv::Mat1b& lid) {
  const cv::Scalar average = cv::mean(even.mean, lid);
  cv::Vec3b colour;
  for (int c = 0; c < 3; ++c) colour[c] = cv::saturate_cast<std::uint8_t>(average[c]);
  cv::Mat1b candidates(lid.size(), 0);
  const int near = 10 + 2 * noise;
  for (int y = 0; y < lid.rows; ++y)
    for (int x = 0; x < lid.cols; ++x)
      if (even.deviation(y, x) <= noise + 2 && distance(even.mean(y, x), colour) <= near) candidates(y, x) = 255;
  const Places places = connected(candidates);
  for (int y = 0; y < lid.rows; ++y)
    for (int x = 0; x < lid.cols; ++x) {
      const int label = places.labels(y, x);
      if (label > 0 && places.stats(label, cv::CC_STAT_AREA) * mm_per_px * mm_per_px >= kLeastHoleMm2)
        lid(y, x) = 255;
    }
}

void drop_crumbs(cv::Mat1b& wood, double mm_per_px) {
  const Places places = connected(wood);
  for (int y = 0; y < wood.rows; ++y)
    for (int x = 0; x < wood.cols; ++x) {
      const int label = places.labels(y, x);
      const int side = std::min(places.stats(label, cv::CC_STAT_WIDTH), places.stats(label, cv::CC_STAT_HEIGHT));
      if (label > 0 && side * mm_per_px < kLeastCrumbMm) wood(y, x) = 0;
    }
}

}  // namespace

cv::Mat1b find_wood(const cv::Mat3b& rgb, double mm_per_px) {
  const Evenness even = evenness_of(rgb, mm_per_px);
  std::vector<int> deviations = border_deviations(even.deviation);
  const int noise = std::max(1, quantile(deviations, kBorderShare));
  cv::Mat1b lid = find_lid(even, noise, mm_per_px);
  if (lid.empty()) return {rgb.size(), static_cast<std::uint8_t>(255)};
  add_holes(even, noise, mm_per_px, lid);
  const int reach = even.window / 2 + static_cast<int>(std::ceil(kSafetyMm / mm_per_px));
  cv::dilate(lid, lid, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  cv::Mat1b wood = ~lid;
  drop_crumbs(wood, mm_per_px);
  return wood;
}

}  // namespace tessera::parquetry

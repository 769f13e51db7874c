#include "tessera/statistics/borders.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tessera/base/portable_math.h"
#include "tessera/statistics/classes.h"

namespace tessera::statistics {
namespace {

constexpr double kSpacings[] = {0.3, 0.6, 1, 1.5, 2.5, 4};
constexpr double kSameDirection = 12 * kPi / 180;
constexpr std::size_t kMostSamples = 30000;

// Binomial, near a normal distribution of deviation 1.4 px. With whole weights all sums are whole numbers below 2^24,
// which are the same in whatever order they are added.
const cv::Matx<float, 9, 1> kSmooth(1, 8, 28, 56, 70, 56, 28, 8, 1);

// The structure tensor of all classes' indicators: across a border the largest change.
struct Tensor {
  cv::Mat1f xx, xy, yy;
};

Tensor tensor_of(const cv::Mat1b& labels) {
  const cv::Size size = labels.size();
  Tensor t{cv::Mat1f(size, 0.0F), cv::Mat1f(size, 0.0F), cv::Mat1f(size, 0.0F)};
  for (int k = 0; k < kMostClasses; ++k) {
    cv::Mat1b is_k = labels == k;
    if (cv::countNonZero(is_k) == 0) continue;
    cv::Mat1f smooth, dx, dy;
    cv::sepFilter2D(cv::Mat1f(is_k / 255.0), smooth, CV_32F, kSmooth, kSmooth);
    cv::Sobel(smooth, dx, CV_32F, 1, 0);
    cv::Sobel(smooth, dy, CV_32F, 0, 1);
    t.xx += dx.mul(dx);
    t.xy += dx.mul(dy);
    t.yy += dy.mul(dy);
  }
  return t;
}

// Direction along the border at each of its pixels, radians in [0, pi); below 0 elsewhere.
cv::Mat1f directions_of(const cv::Mat1b& labels) {
  constexpr float kNone = -1;
  const Tensor t = tensor_of(labels);
  cv::Mat1f directions(labels.size(), kNone);
  for (int y = 0; y + 1 < labels.rows; ++y)
    for (int x = 0; x + 1 < labels.cols; ++x) {
      const int label = labels(y, x);
      if (label == labels(y, x + 1) && label == labels(y + 1, x)) continue;
      const double normal = atan2_portable(2.0 * t.xy(y, x), t.xx(y, x) - t.yy(y, x)) / 2;
      double along = normal + kPi / 2;
      along -= std::floor(along / kPi) * kPi;
      directions(y, x) = static_cast<float>(along);
    }
  return directions;
}

bool is_along(float direction, double wanted) {
  if (direction < 0) return false;
  double turn = std::abs(direction - wanted);
  turn = std::min(turn, kPi - turn);
  return turn < kSameDirection;
}

bool meets_one(const cv::Mat1f& directions, double x, double y, double wanted) {
  const int i = static_cast<int>(std::lround(x)), j = static_cast<int>(std::lround(y));
  for (int v = j - 1; v <= j + 1; ++v)
    for (int u = i - 1; u <= i + 1; ++u)
      if (u >= 0 && v >= 0 && u < directions.cols && v < directions.rows && is_along(directions(v, u), wanted))
        return true;
  return false;
}

struct Border {
  int x, y;
  double direction;
};

std::vector<Border> sampled(const cv::Mat1f& directions) {
  std::vector<Border> all;
  for (int y = 0; y < directions.rows; ++y)
    for (int x = 0; x < directions.cols; ++x)
      if (directions(y, x) >= 0) all.push_back({x, y, directions(y, x)});
  const std::size_t stride = all.size() / kMostSamples + 1;
  std::vector<Border> some;
  for (std::size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

// Length of the mean of directions as angles times `times`.
double alignment(const std::vector<Border>& borders, int times) {
  double cosine = 0, sine = 0;
  for (const Border& b : borders) {
    const SinCos turn = sin_cos(times * b.direction);
    cosine += turn.cos, sine += turn.sin;
  }
  return borders.empty() ? 0 : std::sqrt(cosine * cosine + sine * sine) / static_cast<double>(borders.size());
}

}  // namespace

BorderMarks border_marks(const cv::Mat1b& labels, double spacing) {
  const cv::Mat1f directions = directions_of(labels);
  const std::vector<Border> borders = sampled(directions);
  BorderMarks marks;
  for (const double share : kSpacings) {
    double hits = 0, tries = 0;
    for (const Border& b : borders) {
      const SinCos turn = sin_cos(b.direction);
      for (const double ahead : {share * spacing, -share * spacing}) {
        const double x = b.x + ahead * turn.cos, y = b.y + ahead * turn.sin;
        if (x < 0 || y < 0 || x > labels.cols - 1 || y > labels.rows - 1) continue;
        ++tries;
        if (meets_one(directions, x, y, b.direction)) ++hits;
      }
    }
    marks.push_back(tries > 0 ? hits / tries : 0);
  }
  marks.push_back(alignment(borders, 4));
  marks.push_back(alignment(borders, 6));
  return marks;
}

}  // namespace tessera::statistics

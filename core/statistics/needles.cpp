#include "tessera/statistics/needles.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"
#include "tessera/geometry/point.h"

namespace tessera::statistics {
namespace {

struct Pixel {
  int x, y;
};
struct Needle {
  Pixel from, to;
};

// Both ends in a picture of that size, any place and direction as likely as another.
Needle throw_one(double d, int width, int height, Rng& rng) {
  for (;;) {
    const SinCos turn = sin_cos(rng.uniform(0, 2 * kPi));
    const double x = rng.uniform() * width, y = rng.uniform() * height;
    const double u = x + d * turn.cos, v = y + d * turn.sin;
    if (0 <= u && u < width && 0 <= v && v < height)
      return {{static_cast<int>(x), static_cast<int>(y)}, {static_cast<int>(u), static_cast<int>(v)}};
  }
}

double grey_of(const cv::Vec3b& p) { return (p[0] + p[1] + p[2]) / 3.0; }

struct GreyMoments {
  double mean = 0, variance = 0;
};
GreyMoments grey_moments(const cv::Mat3b& pixels) {
  GreyMoments m;
  const double n = static_cast<double>(pixels.total());
  for (const cv::Vec3b& p : pixels) m.mean += grey_of(p) / n;
  for (const cv::Vec3b& p : pixels) m.variance += (grey_of(p) - m.mean) * (grey_of(p) - m.mean) / n;
  return m;
}

// Sums over the needles of one length, then made chances.
class Tally {
 public:
  Tally(double distance, std::size_t classes) : classes_(classes) {
    s_.distance = distance;
    s_.transitions.assign(classes * classes, 0);
  }

  void add(const cv::Vec3b& a, const cv::Vec3b& b, int class_a, int class_b, double mean) {
    ++s_.needles;
    if (class_a == class_b) ++agreeing_;
    s_.transitions[class_a * classes_ + class_b] += 1;
    for (int c = 0; c < 3; ++c) s_.variogram += (a[c] - b[c]) * (a[c] - b[c]);
    const double grey_a = grey_of(a), grey_b = grey_of(b);
    s_.autocorrelation += (grey_a - mean) * (grey_b - mean);
    const auto bin = [](double grey) { return std::min(kGreyBins - 1, static_cast<int>(grey * kGreyBins / 256)); };
    s_.co_occurrence[bin(grey_a) * kGreyBins + bin(grey_b)] += 1;
    const double place = (grey_b - grey_a + 256) * kDifferenceBins / 512;
    s_.difference[std::min(kDifferenceBins - 1, static_cast<int>(place))] += 1;
  }

  // Two points in different cells agree with the chance of their classes' shares alone.
  NeedleStatistics result(double by_chance, double variance) {
    const double n = static_cast<double>(std::max<std::int64_t>(1, s_.needles));
    const double agree = static_cast<double>(agreeing_) / n;
    if (by_chance < 1) {
      s_.same_cell = (agree - by_chance) / (1 - by_chance);
      s_.same_cell_error = std::sqrt(agree * (1 - agree) / n) / (1 - by_chance);
    }
    s_.variogram /= n;
    s_.autocorrelation = variance > 0 ? s_.autocorrelation / n / variance : 0;
    for (std::size_t i = 0; i < classes_; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < classes_; ++k) sum += s_.transitions[i * classes_ + k];
      for (std::size_t k = 0; k < classes_ && sum > 0; ++k) s_.transitions[i * classes_ + k] /= sum;
    }
    for (double& v : s_.co_occurrence) v /= n;
    for (double& v : s_.difference) v /= n;
    return s_;
  }

 private:
  std::size_t classes_;
  std::int64_t agreeing_ = 0;
  NeedleStatistics s_;
};

// Calls visit(class, length, whole) for each run of a line of `count` labels, `step` apart.
template <class Visit>
void each_run_of(const std::uint8_t* labels, int count, std::size_t step, Visit&& visit) {
  for (int begin = 0; begin < count;) {
    int end = begin + 1;
    while (end < count && labels[end * step] == labels[begin * step]) ++end;
    visit(labels[begin * step], end - begin, begin > 0 && end < count);
    begin = end;
  }
}

template <class Visit>
void each_run_of(const cv::Mat1b& labels, Visit&& visit) {
  for (int y = 0; y < labels.rows; ++y) each_run_of(labels.ptr(y), labels.cols, 1, visit);
  for (int x = 0; x < labels.cols; ++x) each_run_of(labels.ptr(0) + x, labels.rows, labels.step[0], visit);
}

}  // namespace

std::vector<double> shares_of(const Classes& classes) {
  std::vector<double> shares(classes.colours.size(), 0);
  for (const std::uint8_t label : classes.labels) shares[label] += 1 / static_cast<double>(classes.labels.total());
  return shares;
}

double agreement_by_chance(const std::vector<double>& shares) {
  double sum = 0;
  for (const double share : shares) sum += share * share;
  return sum;
}

std::vector<NeedleStatistics> throw_needles(const ImageView& picture, const Classes& classes,
                                            const std::vector<double>& distances, int needles, Rng& rng,
                                            const RunContext& context) {
  const cv::Mat3b pixels = picture.mat();
  const GreyMoments grey = grey_moments(pixels);
  const double by_chance = agreement_by_chance(shares_of(classes));
  std::vector<NeedleStatistics> all;
  for (const double d : distances) {
    if (!context.check()) break;
    Tally tally(d, classes.colours.size());
    for (int k = 0; k < needles; ++k) {
      const auto [a, b] = throw_one(d, pixels.cols, pixels.rows, rng);
      tally.add(pixels(a.y, a.x), pixels(b.y, b.x), classes.labels(a.y, a.x), classes.labels(b.y, b.x), grey.mean);
    }
    all.push_back(tally.result(by_chance, grey.variance));
    context.progress(static_cast<double>(all.size()) / static_cast<double>(distances.size()));
  }
  return all;
}

std::vector<double> same_cell(const cv::Mat1i& cells, const std::vector<double>& distances, int needles, Rng& rng) {
  std::vector<double> all;
  for (const double d : distances) {
    int same = 0;
    for (int k = 0; k < needles; ++k) {
      const auto [a, b] = throw_one(d, cells.cols, cells.rows, rng);
      if (cells(a.y, a.x) == cells(b.y, b.x)) ++same;
    }
    all.push_back(static_cast<double>(same) / needles);
  }
  return all;
}

double agreement(const cv::Mat1b& labels, cv::Point offset) {
  const cv::Rect picture({0, 0}, labels.size());
  const cv::Rect from = picture & (picture - offset);
  if (from.empty()) return 1;
  std::int64_t agreeing = 0;
  for (int y = from.y; y < from.y + from.height; ++y) {
    const std::uint8_t *a = labels.ptr(y) + from.x, *b = labels.ptr(y + offset.y) + from.x + offset.x;
    int of_row = 0;
    for (int x = 0; x < from.width; ++x) of_row += a[x] == b[x];
    agreeing += of_row;
  }
  return static_cast<double>(agreeing) / from.area();
}

std::vector<double> patch_widths(const Classes& classes) {
  std::vector<double> sums(classes.colours.size(), 0), counts(classes.colours.size(), 0);
  each_run_of(classes.labels, [&](int label, int length, bool whole) {
    if (whole) sums[label] += length, counts[label] += 1;
  });
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] = counts[k] > 0 ? sums[k] / counts[k] : 0;
  return sums;
}

double boundary_crossings(const Classes& classes) {
  double runs = 0;
  each_run_of(classes.labels, [&](int, int, bool) { ++runs; });
  const double lines = classes.labels.rows + classes.labels.cols;
  return (runs - lines) / (2 * static_cast<double>(classes.labels.total()));
}

}  // namespace tessera::statistics

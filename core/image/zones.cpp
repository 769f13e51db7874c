#include "tessera/image/zones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tessera/image/palette.h"

namespace tessera {
namespace {

// Takes the stairs out of a hard-edged drawing, at the cost of rounder corners; an anti-aliased one has none.
constexpr double kHardSigma = 1.0, kSoftSigma = 0.5;

cv::Mat blurred(const cv::Mat& image, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(image, out, {5, 5}, sigma, sigma, cv::BORDER_REPLICATE);
  return out;
}

// Mean grey of the levels in [begin, end), or `otherwise` where there are none.
double mean_level(const GreyHistogram& histogram, int begin, int end, double otherwise) {
  double count = 0, sum = 0;
  for (int i = begin; i < end; ++i) {
    count += histogram[i];
    sum += i * histogram[i];
  }
  return count > 0 ? sum / count : otherwise;
}

// Otsu's threshold on the histogram, then half way between the two means.
double find_threshold(const GreyHistogram& histogram) {
  double total = 0, sum = 0;
  for (int i = 0; i < 256; ++i) {
    total += histogram[i];
    sum += i * histogram[i];
  }
  double best = -1, below = 0, below_sum = 0;
  int threshold = 128;
  for (int i = 0; i < 255; ++i) {
    below += histogram[i];
    below_sum += i * histogram[i];
    const double above = total - below;
    if (below == 0 || above == 0) continue;
    const double difference = below_sum / below - (sum - below_sum) / above;
    const double between = below * above * difference * difference;
    if (between > best) {
      best = between;
      threshold = i + 1;
    }
  }
  if (best < 0) return 127.5;  // one level only
  return 0.5 * (mean_level(histogram, 0, threshold, 0) + mean_level(histogram, threshold, 256, 255));
}

}  // namespace

double Zones::frontier(double x, double y, int a, int b) const {
  const double u = std::clamp(x - 0.5, 0.0, smooth.cols - 1.0), v = std::clamp(y - 0.5, 0.0, smooth.rows - 1.0);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const int i1 = std::min(i + 1, smooth.cols - 1), j1 = std::min(j + 1, smooth.rows - 1);
  const double s = u - i, t = v - j;
  const auto blend = [&](double p, double q, double r, double w) {
    return (1 - t) * ((1 - s) * p + s * q) + t * ((1 - s) * r + s * w);
  };
  if (smooth.channels() == 1) {
    const unsigned char *row = smooth.ptr(j), *next = smooth.ptr(j1);
    const double grey = blend(row[i], row[i1], next[i], next[i1]);
    const double range = levels[b][0] - levels[a][0];
    return (grey - threshold) / range;
  }
  const cv::Vec3b *row = smooth.ptr<cv::Vec3b>(j), *next = smooth.ptr<cv::Vec3b>(j1);
  double along = 0, norm = 0;
  for (int c = 0; c < 3; ++c) {
    const double way = levels[b][c] - levels[a][c];
    along += (blend(row[i][c], row[i1][c], next[i][c], next[i1][c]) - levels[a][c]) * way;
    norm += way * way;
  }
  return std::clamp(along / std::max(norm, 1e-9), 0.0, 1.0) - 0.5;
}

cv::Mat1b grey_of(const cv::Mat3b& drawing) {
  cv::Mat1b grey;
  cv::cvtColor(drawing, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

void add_levels(const cv::Mat1b& grey, GreyHistogram& histogram) {
  for (int y = 0; y < grey.rows; ++y)
    for (const unsigned char* p = grey[y]; p != grey[y] + grey.cols; ++p) ++histogram[*p];
}

ZoneRule two_zones(const GreyHistogram& histogram, double threshold) {
  ZoneRule rule;
  rule.threshold = threshold > 0 ? threshold * 255 : find_threshold(histogram);
  const int first_white = rule.first_white();
  const float dark = static_cast<float>(mean_level(histogram, 0, first_white, 0));
  const float light = static_cast<float>(mean_level(histogram, first_white, 256, 255));
  rule.levels = {cv::Vec3f::all(dark), cv::Vec3f::all(std::max(light, dark + 1))};
  rule.palette = {{34, 34, 34}, {232, 232, 228}};
  rule.lightest = light;
  return rule;
}

int ZoneRule::first_white() const { return static_cast<int>(std::ceil(threshold)); }

void add_crossings(const cv::Mat1b& grey, const ZoneRule& rule, Crossings& crossings) {
  const float dark = rule.levels[0][0], light = rule.lightest;
  const double low = dark + 0.1 * (light - dark), high = light - 0.1 * (light - dark);
  const int first_white = rule.first_white();
  for (int y = 0; y < grey.rows; ++y) {
    const unsigned char* row = grey[y];
    for (int x = 1; x < grey.cols; ++x) {
      if ((row[x] >= first_white) == (row[x - 1] >= first_white)) continue;
      ++crossings.all;
      const auto blends = [&](unsigned char v) { return v > low && v < high; };
      crossings.blended += blends(row[x]) || blends(row[x - 1]);
    }
  }
}

void smooth_as(const Crossings& crossings, ZoneRule& rule) {
  rule.sigma = 2 * crossings.blended > crossings.all ? kSoftSigma : kHardSigma;
}

namespace {

Zones divided(const cv::Mat1b& grey, const ZoneRule& rule) {
  Zones zones;
  zones.threshold = rule.threshold;
  // The same rule for both, so that a pixel's zone and the frontier beside it agree.
  cv::threshold(grey, zones.map, rule.first_white() - 1, 1, cv::THRESH_BINARY);
  zones.smooth = blurred(grey, rule.sigma);
  zones.levels = rule.levels;
  zones.palette = rule.palette;
  return zones;
}

}  // namespace

Zones black_and_white(const cv::Mat3b& drawing, double threshold) {
  const cv::Mat1b grey = grey_of(drawing);
  GreyHistogram histogram{};
  add_levels(grey, histogram);
  ZoneRule rule = two_zones(histogram, threshold);
  Crossings crossings;
  add_crossings(grey, rule, crossings);
  smooth_as(crossings, rule);
  return divided(grey, rule);
}

double threshold_for_share(const GreyHistogram& histogram, double share) {
  double total = 0;
  for (const double count : histogram) total += count;
  double below = 0;
  int level = 0;
  while (level < 255 && below + histogram[level] <= share * total) below += histogram[level++];
  return std::max(1, level) / 255.0;
}

namespace {

cv::Mat3f lab_of(const cv::Mat3b& drawing) {
  cv::Mat3f scaled, lab;
  drawing.convertTo(scaled, CV_32F, 1.0 / 255);
  cv::cvtColor(scaled, lab, cv::COLOR_RGB2Lab);
  return lab;
}

// A pixel is solid where its 3x3 neighbourhood is of one zone; anti-aliased rims are not.
cv::Mat1b solid_pixels(const cv::Mat1b& map) {
  cv::Mat1b least, most;
  cv::erode(map, least, cv::Mat1b::ones(3, 3));
  cv::dilate(map, most, cv::Mat1b::ones(3, 3));
  return least == most;
}

// Gives pixels that blend two solid zones nearby to the nearer of the two.
void absorb_blends(Zones& zones, const cv::Mat3b& drawing) {
  const cv::Mat1b solid = solid_pixels(zones.map);
  const cv::Mat1b before = zones.map.clone();
  constexpr int kReach = 2;
  for (int y = 0; y < before.rows; ++y) {
    for (int x = 0; x < before.cols; ++x) {
      if (solid(y, x)) continue;
      bool near[256] = {};
      for (int j = std::max(0, y - kReach); j <= std::min(before.rows - 1, y + kReach); ++j)
        for (int i = std::max(0, x - kReach); i <= std::min(before.cols - 1, x + kReach); ++i)
          if (solid(j, i)) near[before(j, i)] = true;
      if (near[before(y, x)]) continue;
      const cv::Vec3b colour = drawing(y, x);
      double least = 1e30;
      for (std::size_t k = 0; k < zones.levels.size(); ++k) {
        const double d = cv::norm(cv::Vec3f(colour) - zones.levels[k], cv::NORM_L2SQR);
        if (near[k] && d < least) {
          least = d;
          zones.map(y, x) = static_cast<unsigned char>(k);
        }
      }
    }
  }
}

// About 128 x 128 samples decide the palette.
int sample_step(cv::Size size) {
  return std::max(1, static_cast<int>(std::sqrt(static_cast<double>(size.width) * size.height / 16384)));
}

void add_lab_samples(const cv::Mat3f& lab, cv::Size whole, int first_row, cv::Mat1f& samples) {
  const int step = sample_step(whole);
  for (int y = 0; y < lab.rows; ++y) {
    if ((first_row + y) % step != step / 2) continue;
    for (int x = step / 2; x < lab.cols; x += step) {
      const cv::Vec3f v = lab(y, x);
      samples.push_back(cv::Mat1f({1, 3}, {v[0], v[1], v[2]}));
    }
  }
}

Zones divided(const cv::Mat3b& drawing, const cv::Mat3f& lab, const ZoneRule& rule) {
  Zones zones;
  zones.map.create(drawing.size());
  for (int y = 0; y < lab.rows; ++y) {
    for (int x = 0; x < lab.cols; ++x) {
      zones.map(y, x) = static_cast<unsigned char>(nearest_colour(rule.centres, lab(y, x)));
    }
  }
  zones.palette = rule.palette;
  zones.levels = rule.levels;
  absorb_blends(zones, drawing);
  zones.smooth = blurred(drawing, rule.sigma);
  return zones;
}

}  // namespace

void add_samples(const cv::Mat3b& part, cv::Size whole, int first_row, cv::Mat1f& samples) {
  add_lab_samples(lab_of(part), whole, first_row, samples);
}

ZoneRule colour_rule(const cv::Mat1f& samples, int colors) {
  ZoneRule rule;
  rule.centres = lab_palette(samples, colors);
  rule.palette = to_rgb(rule.centres);
  for (const Rgb c : rule.palette) rule.levels.push_back(cv::Vec3f(c.r, c.g, c.b));
  rule.sigma = kSoftSigma;
  return rule;
}

Zones colour_zones(const cv::Mat3b& drawing, int colors) {
  const cv::Mat3f lab = lab_of(drawing);
  cv::Mat1f samples(0, 3);
  add_lab_samples(lab, drawing.size(), 0, samples);
  return divided(drawing, lab, colour_rule(samples, colors));
}

Zones divide(const cv::Mat3b& part, const ZoneRule& rule) {
  return rule.centres.empty() ? divided(grey_of(part), rule) : divided(part, lab_of(part), rule);
}

}  // namespace tessera

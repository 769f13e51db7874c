#include "tessera/statistics/classes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "tessera/image/lab.h"
#include "tessera/image/palette.h"

namespace tessera::statistics {
namespace {

constexpr double kLeastShare = 0.01;    // of the picture, for a colour that counts
constexpr double kDiscreteShare = 0.5;  // of the picture, in such colours, for it to be made of them
constexpr int kPure = 16;               // levels, from a class's colour to a pixel that has it
constexpr int kCells = 32;              // a channel, of the table of frequent colours
constexpr int kSamples = 20000;         // pixels, at most, that k-means looks at

int difference(Rgb a, const cv::Vec3b& b) {
  return std::max({std::abs(a.r - b[0]), std::abs(a.g - b[1]), std::abs(a.b - b[2])});
}
int distance2(Rgb a, const cv::Vec3b& b) {
  const int r = a.r - b[0], g = a.g - b[1], c = a.b - b[2];
  return r * r + g * g + c * c;
}

struct Frequent {
  std::int64_t count = 0, r = 0, g = 0, b = 0;
};

// Colours that many pixels have, nearly, with how many they are.
std::vector<std::pair<Rgb, std::int64_t>> frequent_colours(const cv::Mat3b& pixels) {
  std::vector<Frequent> table(static_cast<std::size_t>(kCells) * kCells * kCells);
  for (const cv::Vec3b& p : pixels) {
    constexpr int kStep = 256 / kCells;
    Frequent& f = table[(p[0] / kStep * kCells + p[1] / kStep) * kCells + p[2] / kStep];
    ++f.count, f.r += p[0], f.g += p[1], f.b += p[2];
  }
  std::stable_sort(table.begin(), table.end(),
                   [](const Frequent& a, const Frequent& b) { return a.count > b.count; });
  std::vector<std::pair<Rgb, std::int64_t>> colours;
  for (const Frequent& f : table) {
    if (f.count < kLeastShare * static_cast<double>(pixels.total())) break;
    const auto mean = [&](std::int64_t sum) {
      return static_cast<std::uint8_t>((2 * sum + f.count) / (2 * f.count));
    };
    const Rgb colour{mean(f.r), mean(f.g), mean(f.b)};
    // A colour at the limit of two cells of the table is in both.
    const auto same = std::find_if(colours.begin(), colours.end(), [&](const auto& other) {
      return difference(other.first, {colour.r, colour.g, colour.b}) <= kPure;
    });
    if (same != colours.end())
      same->second += f.count;
    else if (colours.size() < kMostClasses)
      colours.emplace_back(colour, f.count);
  }
  return colours;
}

std::vector<Rgb> clustered_colours(const cv::Mat3b& pixels, int count) {
  const std::size_t stride = pixels.total() / kSamples + 1;
  std::vector<Rgb> samples;
  std::size_t i = 0;
  for (const cv::Vec3b& p : pixels)
    if (i++ % stride == 0) samples.push_back({p[0], p[1], p[2]});
  return to_rgb(lab_palette(to_lab(samples), count));
}

std::uint8_t nearest(const std::vector<Rgb>& colours, const cv::Vec3b& pixel) {
  const auto best = std::min_element(colours.begin(), colours.end(),
                                     [&](Rgb a, Rgb b) { return distance2(a, pixel) < distance2(b, pixel); });
  return static_cast<std::uint8_t>(best - colours.begin());
}

// Pixels that are of no class take the class of a neighbour that has one, of those whose colour is the nearest; again
// and again, until none is left.
void settle_mixed(const cv::Mat3b& pixels, const std::vector<Rgb>& colours, cv::Mat1b& labels) {
  constexpr std::uint8_t kMixed = 255;
  for (int y = 0; y < pixels.rows; ++y)
    for (int x = 0; x < pixels.cols; ++x)
      if (difference(colours[labels(y, x)], pixels(y, x)) > kPure) labels(y, x) = kMixed;
  for (int round = 0; round < 4; ++round) {
    const cv::Mat1b before = labels.clone();
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x) {
        if (before(y, x) != kMixed) continue;
        int best = -1;
        for (int j = std::max(0, y - 1); j <= std::min(labels.rows - 1, y + 1); ++j)
          for (int i = std::max(0, x - 1); i <= std::min(labels.cols - 1, x + 1); ++i) {
            const int other = before(j, i);
            if (other == kMixed) continue;
            if (best < 0 || distance2(colours[other], pixels(y, x)) < distance2(colours[best], pixels(y, x)))
              best = other;
          }
        if (best >= 0) labels(y, x) = static_cast<std::uint8_t>(best);
      }
  }
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (labels(y, x) == kMixed) labels(y, x) = nearest(colours, pixels(y, x));
}

}  // namespace

Classes find_classes(const ImageView& picture, int wanted) {
  constexpr int kFewest = 2, kClusters = 4;
  const cv::Mat3b pixels = picture.mat();
  Classes classes;
  std::int64_t covered = 0;
  for (const auto& [colour, count] : frequent_colours(pixels)) {
    classes.colours.push_back(colour);
    covered += count;
  }
  const auto found = static_cast<int>(classes.colours.size());
  classes.discrete = static_cast<double>(covered) >= kDiscreteShare * static_cast<double>(pixels.total()) &&
                     (wanted == 0 || wanted == found);
  if (!classes.discrete)
    classes.colours = clustered_colours(pixels, wanted == 0 ? kClusters : std::max(wanted, kFewest));
  classes.labels.create(pixels.size());
  for (int y = 0; y < pixels.rows; ++y)
    for (int x = 0; x < pixels.cols; ++x) classes.labels(y, x) = nearest(classes.colours, pixels(y, x));
  if (classes.discrete) settle_mixed(pixels, classes.colours, classes.labels);
  return classes;
}

}  // namespace tessera::statistics

#include "tessera/patterns/pixel_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tessera/points/density.h"

namespace tessera::patterns {
namespace {

int distance2(const Levels& a, const Levels& b) {
  int sum = 0;
  for (std::size_t k = 0; k < kMostChannels; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

const ColourClass& nearest_class(const ColourModel& model, const Levels& colour) {
  return *std::min_element(model.classes.begin(), model.classes.end(),
                           [&](const ColourClass& a, const ColourClass& b) {
                             return distance2(a.mean, colour) < distance2(b.mean, colour);
                           });
}

std::vector<Levels> correlated_colours(const ColourModel& model, double correlation, const Window& window, Rng& rng) {
  const ColourClass& of = model.classes[0];
  std::vector<Density> fields;
  for (int k = 0; k < model.channels; ++k) fields.push_back(gaussian_field(window, correlation, rng));
  std::vector<Levels> colours;
  for (double y = window.low.y; y < window.high.y; ++y)
    for (double x = window.low.x; x < window.high.x; ++x) {
      Noise noise{};
      for (std::size_t k = 0; k < fields.size(); ++k) noise[k] = fields[k].at({x + 0.5, y + 0.5});
      colours.push_back(varied_colour(of, of.mean, noise, model.channels));
    }
  return colours;
}

// A line of `count` values, `step` apart, each replaced by the mean of `side` values about it.
void filter_line(std::uint8_t* line, int count, std::ptrdiff_t step, int side, bool seamless,
                 std::vector<std::uint8_t>& copy) {
  copy.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) copy[i] = line[i * step];
  const auto at = [&](int i) {
    return static_cast<int>(copy[seamless ? (i % count + count) % count : std::clamp(i, 0, count - 1)]);
  };
  const int before = (side - 1) / 2;
  int sum = 0;
  for (int k = 0; k < side; ++k) sum += at(k - before);
  for (int i = 0; i < count; ++i) {
    line[i * step] = static_cast<std::uint8_t>((2 * sum + side) / (2 * side));
    sum += at(i + side - before) - at(i - before);
  }
}

}  // namespace

std::vector<Levels> pixel_colours(const ColourModel& model, double correlation, const Window& window, Rng& rng) {
  if (correlation > 0) return correlated_colours(model, correlation, window, rng);
  std::vector<Levels> colours;
  for (double y = window.low.y; y < window.high.y; ++y)
    for (double x = window.low.x; x < window.high.x; ++x) {
      const ColourClass& its = draw_class(model, rng);
      colours.push_back(draw_colour(its, its.mean, model.channels, rng));
    }
  return colours;
}

void add_noise(Raster& picture, const ColourModel& model, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kPixels);
  const auto channels = static_cast<std::size_t>(model.channels);
  for (std::size_t i = 0; i + channels <= picture.bytes.size(); i += channels) {
    const auto pixel = picture.bytes.begin() + static_cast<std::ptrdiff_t>(i);
    Levels before{};
    std::copy_n(pixel, channels, before.begin());
    const Levels after = draw_colour(nearest_class(model, before), before, model.channels, rng);
    std::copy_n(after.begin(), channels, pixel);
  }
}

void mean_filter(Raster& picture, int side, bool seamless) {
  if (side < 2) return;
  const std::ptrdiff_t pixel = picture.channels, row = pixel * picture.width;
  std::vector<std::uint8_t> copy;
  for (int c = 0; c < picture.channels; ++c) {
    for (int y = 0; y < picture.height; ++y)
      filter_line(&picture.bytes[static_cast<std::size_t>(y * row + c)], picture.width, pixel, side, seamless, copy);
    for (int x = 0; x < picture.width; ++x)
      filter_line(&picture.bytes[static_cast<std::size_t>(x * pixel + c)], picture.height, row, side, seamless, copy);
  }
}

}  // namespace tessera::patterns

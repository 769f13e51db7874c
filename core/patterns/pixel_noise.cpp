#include "tessera/patterns/pixel_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tessera/points/density.h"

namespace tessera::patterns {
namespace {

int distance2(Rgb a, Rgb b) {
  const int r = a.r - b.r, g = a.g - b.g, k = a.b - b.b;
  return r * r + g * g + k * k;
}

const ColourClass& nearest_class(const ColourModel& model, Rgb colour) {
  return *std::min_element(model.begin(), model.end(), [&](const ColourClass& a, const ColourClass& b) {
    return distance2(a.mean, colour) < distance2(b.mean, colour);
  });
}

std::vector<Rgb> correlated_colours(const ColourClass& of, double correlation, const Window& window, Rng& rng) {
  const Density fields[] = {gaussian_field(window, correlation, rng), gaussian_field(window, correlation, rng),
                            gaussian_field(window, correlation, rng)};
  std::vector<Rgb> colours;
  for (double y = window.low.y; y < window.high.y; ++y)
    for (double x = window.low.x; x < window.high.x; ++x) {
      const Point p{x + 0.5, y + 0.5};
      colours.push_back(varied_colour(of, of.mean, {fields[0].at(p), fields[1].at(p), fields[2].at(p)}));
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

std::vector<Rgb> pixel_colours(const ColourModel& model, double correlation, const Window& window, Rng& rng) {
  if (correlation > 0) return correlated_colours(model[0], correlation, window, rng);
  std::vector<Rgb> colours;
  for (double y = window.low.y; y < window.high.y; ++y)
    for (double x = window.low.x; x < window.high.x; ++x) {
      const ColourClass& its = draw_class(model, rng);
      colours.push_back(draw_colour(its, its.mean, rng));
    }
  return colours;
}

void add_noise(Raster& picture, const ColourModel& model, std::uint64_t seed) {
  Rng rng(seed, RngPurpose::kPixels);
  for (std::size_t i = 0; i + 2 < picture.bytes.size(); i += 3) {
    const Rgb before{picture.bytes[i], picture.bytes[i + 1], picture.bytes[i + 2]};
    const Rgb after = draw_colour(nearest_class(model, before), before, rng);
    picture.bytes[i] = after.r, picture.bytes[i + 1] = after.g, picture.bytes[i + 2] = after.b;
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

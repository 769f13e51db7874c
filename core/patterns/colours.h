// How cells are coloured (section 3): one of m colours with given probabilities, each a normal distribution of its
// channels.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/base/rng.h"
#include "tessera/base/text.h"

namespace tessera::patterns {

constexpr std::size_t kMostChannels = 4;

// Of the channels there are, from the first: grey; grey and opacity; red, green, blue; these and opacity.
using Levels = std::array<std::uint8_t, kMostChannels>;
using Noise = std::array<double, kMostChannels>;

struct ColourClass {
  Levels mean{};
  double share = 1;                         // of all cells; those of a model add up to 1
  std::array<Noise, kMostChannels> root{};  // L of the covariance L L^T, lower triangular, levels
};

struct ColourModel {
  std::vector<ColourClass> classes;  // not empty
  int channels = 3;                  // 1 to kMostChannels
};

struct ColourTexts {
  int channels;
  const std::string &colors, &probabilities, &covariance, &border_color;
};
struct ColourProblem {
  const char* key;
  const char* message;
};

// What the parameters of these names say. With problems the model and the border's colour are of no use.
std::vector<ColourProblem> read_colours(const ColourTexts& texts, ColourModel& model, Levels& border);

const ColourClass& draw_class(const ColourModel& model, Rng& rng);
// About `mean` as the class varies, within 0..255; `noise` are numbers of variance 1, one a channel.
Levels varied_colour(const ColourClass& of, const Levels& mean, const Noise& noise, int channels);
// The same with noise of its own.
Levels draw_colour(const ColourClass& of, const Levels& mean, int channels, Rng& rng);

// What levels look like: grey as three alike, without opacity as opaque.
Rgb fill_of(const Levels& levels, int channels);
std::uint8_t opacity_of(const Levels& levels, int channels);

}  // namespace tessera::patterns

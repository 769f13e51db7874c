#include "tessera/patterns/colours.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tessera/base/distributions.h"

namespace tessera::patterns {
namespace {

constexpr std::string_view kSpaces = " \t\r\n,";
constexpr std::size_t kMostColours = 256;

constexpr ColourProblem kNoColours{"colors",
                                   "is no list of 1 to 256 colours, expected such as \"#22313f #d9cfc1\" "
                                   "(#rrggbbaa with 2 or 4 channels)"};
constexpr ColourProblem kNoShares{
    "probabilities", "is no list of numbers above 0, one a colour, expected such as \"0.6 0.4\", or nothing"};
constexpr ColourProblem kNoCovariance{
    "covariance",
    "is no covariance, expected one number, n or n (n + 1) / 2 of a positive matrix for "
    "n channels, once or for each colour with semicolons between"};
constexpr ColourProblem kNoBorder{"borderColor", "is no colour, expected one such as \"#1b1a18\""};

bool has_opacity(int channels) { return channels % 2 == 0; }

bool read_numbers(std::string_view text, std::vector<double>& numbers) {
  numbers.clear();
  for (const std::string_view word : split(text, kSpaces)) {
    double number = 0;
    if (!parse_number(word, number) || !std::isfinite(number)) return false;
    numbers.push_back(number);
  }
  return true;
}

// The Cholesky root of a covariance of n channels; false where it has none.
bool factor(const std::vector<double>& numbers, std::size_t n, std::array<Noise, kMostChannels>& root) {
  double c[kMostChannels][kMostChannels] = {};
  if (numbers.size() == n * (n + 1) / 2 && n > 1) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = i; k < n; ++k) c[i][k] = c[k][i] = numbers[next++];
  } else if (numbers.size() == 1 || numbers.size() == n) {
    for (std::size_t k = 0; k < n; ++k) c[k][k] = numbers[numbers.size() == 1 ? 0 : k];
  } else {
    return false;
  }
  root = {};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      double rest = c[i][k];
      for (std::size_t m = 0; m < k; ++m) rest -= root[i][m] * root[k][m];
      if (i == k) {
        if (rest < -1e-9) return false;
        root[i][i] = std::sqrt(std::max(0.0, rest));
      } else {
        if (root[k][k] == 0 && std::abs(rest) > 1e-9) return false;
        root[i][k] = root[k][k] > 0 ? rest / root[k][k] : 0;
      }
    }
  }
  return true;
}

bool read_levels(std::string_view text, int channels, Levels& levels) {
  Rgb colour;
  std::uint8_t opacity = 255;
  if (!parse_colour(text, colour, opacity) || (opacity != 255 && !has_opacity(channels))) return false;
  const auto grey = static_cast<std::uint8_t>((2 * (colour.r + colour.g + colour.b) + 3) / 6);
  levels = channels < 3 ? Levels{grey, opacity} : Levels{colour.r, colour.g, colour.b, opacity};
  if (!has_opacity(channels)) levels[static_cast<std::size_t>(channels)] = 0;  // there is no such channel
  return true;
}

bool read_means(const std::string& text, ColourModel& model) {
  for (const std::string_view word : split(text, " \t\r\n,;")) {
    ColourClass next;
    if (!read_levels(word, model.channels, next.mean)) return false;
    model.classes.push_back(next);
  }
  return !model.classes.empty() && model.classes.size() <= kMostColours;
}

bool read_shares(const std::string& text, ColourModel& model) {
  std::vector<double> shares;
  if (!read_numbers(text, shares)) return false;
  if (shares.empty()) shares.assign(model.classes.size(), 1);
  if (shares.size() != model.classes.size()) return false;
  double sum = 0;
  for (const double share : shares) {
    if (!(share > 0)) return false;
    sum += share;
  }
  for (std::size_t k = 0; k < shares.size(); ++k) model.classes[k].share = shares[k] / sum;
  return std::isfinite(sum);
}

bool read_roots(const std::string& text, ColourModel& model) {
  const auto matrices = split(text, ";");
  if (matrices.size() != 1 && matrices.size() != model.classes.size()) return false;
  for (std::size_t k = 0; k < model.classes.size(); ++k) {
    std::vector<double> numbers;
    if (!read_numbers(matrices[matrices.size() == 1 ? 0 : k], numbers) ||
        !factor(numbers, static_cast<std::size_t>(model.channels), model.classes[k].root))
      return false;
  }
  return true;
}

}  // namespace

std::vector<ColourProblem> read_colours(const ColourTexts& texts, ColourModel& model, Levels& border) {
  model = {{}, texts.channels};
  std::vector<ColourProblem> problems;
  if (!read_levels(texts.border_color, texts.channels, border)) problems.push_back(kNoBorder);
  if (!read_means(texts.colors, model)) {
    problems.push_back(kNoColours);
    return problems;
  }
  if (!read_shares(texts.probabilities, model)) problems.push_back(kNoShares);
  if (!read_roots(texts.covariance, model)) problems.push_back(kNoCovariance);
  return problems;
}

const ColourClass& draw_class(const ColourModel& model, Rng& rng) {
  double rest = rng.uniform();
  for (const ColourClass& candidate : model.classes)
    if ((rest -= candidate.share) < 0) return candidate;
  return model.classes.back();
}

Levels varied_colour(const ColourClass& of, const Levels& mean, const Noise& noise, int channels) {
  Levels levels{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
    double value = mean[k];
    for (std::size_t m = 0; m <= k; ++m) value += of.root[k][m] * noise[m];
    levels[k] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  }
  return levels;
}

Levels draw_colour(const ColourClass& of, const Levels& mean, int channels, Rng& rng) {
  Noise noise{};
  for (int k = 0; k < channels; ++k) noise[static_cast<std::size_t>(k)] = draw_normal(rng);
  return varied_colour(of, mean, noise, channels);
}

Rgb fill_of(const Levels& levels, int channels) {
  return channels < 3 ? Rgb{levels[0], levels[0], levels[0]} : Rgb{levels[0], levels[1], levels[2]};
}

std::uint8_t opacity_of(const Levels& levels, int channels) {
  return has_opacity(channels) ? levels[static_cast<std::size_t>(channels) - 1] : std::uint8_t{255};
}

}  // namespace tessera::patterns

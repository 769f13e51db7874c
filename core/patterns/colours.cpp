#include "tessera/patterns/colours.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tessera/base/distributions.h"

namespace tessera::patterns {
namespace {

constexpr std::string_view kSpaces = " \t\r\n,";
constexpr std::size_t kMostColours = 256;

constexpr ColourProblem kNoColours{"colors", "is no list of 1 to 256 colours, expected such as \"#22313f #d9cfc1\""};
constexpr ColourProblem kNoShares{
    "probabilities", "is no list of numbers above 0, one a colour, expected such as \"0.6 0.4\", or nothing"};
constexpr ColourProblem kNoCovariance{"covariance",
                                      "is no covariance, expected 1, 3 or 6 numbers of a positive matrix, once or "
                                      "for each colour with semicolons between"};

bool read_numbers(std::string_view text, std::vector<double>& numbers) {
  numbers.clear();
  for (const std::string_view word : split(text, kSpaces)) {
    double number = 0;
    if (!parse_number(word, number) || !std::isfinite(number)) return false;
    numbers.push_back(number);
  }
  return true;
}

// The Cholesky root of a covariance; false where it has none.
bool factor(const std::vector<double>& numbers, std::array<Vector3, 3>& root) {
  double c[3][3] = {};
  if (numbers.size() == 1 || numbers.size() == 3) {
    for (std::size_t k = 0; k < 3; ++k) c[k][k] = numbers[numbers.size() == 1 ? 0 : k];
  } else if (numbers.size() == 6) {
    const std::size_t place[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) c[i][k] = numbers[place[i][k]];
  } else {
    return false;
  }
  root = {};
  for (std::size_t i = 0; i < 3; ++i) {
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

bool read_means(const std::string& text, ColourModel& model) {
  for (const std::string_view word : split(text, " \t\r\n,;")) {
    ColourClass next;
    if (!parse_colour(word, next.mean)) return false;
    model.push_back(next);
  }
  return !model.empty() && model.size() <= kMostColours;
}

bool read_shares(const std::string& text, ColourModel& model) {
  std::vector<double> shares;
  if (!read_numbers(text, shares)) return false;
  if (shares.empty()) shares.assign(model.size(), 1);
  if (shares.size() != model.size()) return false;
  double sum = 0;
  for (const double share : shares) {
    if (!(share > 0)) return false;
    sum += share;
  }
  for (std::size_t k = 0; k < shares.size(); ++k) model[k].share = shares[k] / sum;
  return std::isfinite(sum);
}

bool read_roots(const std::string& text, ColourModel& model) {
  const auto matrices = split(text, ";");
  if (matrices.size() != 1 && matrices.size() != model.size()) return false;
  for (std::size_t k = 0; k < model.size(); ++k) {
    std::vector<double> numbers;
    if (!read_numbers(matrices[matrices.size() == 1 ? 0 : k], numbers) || !factor(numbers, model[k].root))
      return false;
  }
  return true;
}

}  // namespace

std::vector<ColourProblem> read_colours(const ColourTexts& texts, ColourModel& model) {
  model.clear();
  if (!read_means(texts.colors, model)) return {kNoColours};
  std::vector<ColourProblem> problems;
  if (!read_shares(texts.probabilities, model)) problems.push_back(kNoShares);
  if (!read_roots(texts.covariance, model)) problems.push_back(kNoCovariance);
  return problems;
}

const ColourClass& draw_class(const ColourModel& model, Rng& rng) {
  double rest = rng.uniform();
  for (const ColourClass& candidate : model)
    if ((rest -= candidate.share) < 0) return candidate;
  return model.back();
}

Rgb varied_colour(const ColourClass& of, Rgb mean, const Vector3& noise) {
  const auto channel = [&](std::uint8_t level, std::size_t k) {
    double value = level;
    for (std::size_t m = 0; m <= k; ++m) value += of.root[k][m] * noise[m];
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  return {channel(mean.r, 0), channel(mean.g, 1), channel(mean.b, 2)};
}

Rgb draw_colour(const ColourClass& of, Rgb mean, Rng& rng) {
  Vector3 noise;
  for (double& n : noise) n = draw_normal(rng);
  return varied_colour(of, mean, noise);
}

}  // namespace tessera::patterns

// How cells are coloured (section 3): one of m colours with given probabilities, each a normal distribution of red,
// green and blue.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/base/rng.h"
#include "tessera/base/text.h"

namespace tessera::patterns {

using Vector3 = std::array<double, 3>;

struct ColourClass {
  Rgb mean;
  double share = 1;               // of all cells; those of a model add up to 1
  std::array<Vector3, 3> root{};  // L of the covariance L L^T, lower triangular, levels
};

using ColourModel = std::vector<ColourClass>;  // not empty

struct ColourTexts {
  const std::string &colors, &probabilities, &covariance;
};
struct ColourProblem {
  const char* key;
  const char* message;
};

// What the parameters of these names say. With problems the model is of no use.
std::vector<ColourProblem> read_colours(const ColourTexts& texts, ColourModel& model);

const ColourClass& draw_class(const ColourModel& model, Rng& rng);
// About `mean` as the class varies, within 0..255; `noise` are three numbers of variance 1.
Rgb varied_colour(const ColourClass& of, Rgb mean, const Vector3& noise);
// The same with noise of its own.
Rgb draw_colour(const ColourClass& of, Rgb mean, Rng& rng);

}  // namespace tessera::patterns

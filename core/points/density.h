// How an intensity varies over a window.
#pragma once

#include <vector>

#include "tessera/base/rng.h"
#include "tessera/points/window.h"

namespace tessera {

// A value a rectangle of a grid over `window`; it goes on beyond, or comes again where the window is periodic.
struct Density {
  Window window;
  int columns = 0, rows = 0;   // >= 1
  std::vector<double> values;  // columns * rows from the top left, >= 0

  double at(Point p) const;
  double largest() const;
};

// A Gaussian random field: mean 0, variance 1, covariance exp(-d^2 / (2 scale^2)), a value for each rectangle of at
// most a sixth of the scale. White noise under a Gaussian kernel.
Density gaussian_field(const Window& window, double scale, Rng& rng);
// exp(deviation field - deviation^2 / 2), so that its mean is 1: the intensity of a log-Gaussian Cox process.
Density log_gaussian_density(const Window& window, double scale, double deviation, Rng& rng);

}  // namespace tessera

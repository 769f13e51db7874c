// Random points of the plane: processes of "Random Pattern Generation Processes" (Schachter and Ahuja 1979), section
// 2, and blue noise. Each is a realization of the stationary process of the whole plane as the window sees it: what
// lies outside has had its say. In a periodic window there is no outside.
#pragma once

#include <vector>

#include "tessera/base/rng.h"
#include "tessera/points/density.h"
#include "tessera/points/window.h"

namespace tessera {

// (1) Poisson: numbers in disjoint regions are independent, of mean intensity * area.
std::vector<Point> poisson_points(const Window& window, double intensity, Rng& rng);
// The same on a square grid of that spacing, counted from the window's corner: each of its points is taken with
// probability 1 - exp(-intensity spacing^2).
std::vector<Point> binomial_points(const Window& window, double intensity, double spacing, Rng& rng);
// (2) Neyman-Scott: Poisson parents, which are not among the points, with a Poisson number of children each (mean
// `family`), normally distributed about them with that deviation an axis (Thomas process). Intensity parents family,
// K(t) = pi t^2 + (1 - exp(-t^2 / (4 spread^2))) / parents.
std::vector<Point> cluster_points(const Window& window, double parents, double family, double spread, Rng& rng);
// (3) Matern I: a Poisson process without the points that are within 2d of another: intensity alpha exp(-4 pi alpha
// d^2).
std::vector<Point> matern1_points(const Window& window, double alpha, double d, Rng& rng);
// Matern II: points come one after another, and one goes that comes within 2d of an earlier, whether that stays or
// not: intensity (1 - exp(-4 pi alpha d^2)) / (4 pi d^2).
std::vector<Point> matern2_points(const Window& window, double alpha, double d, Rng& rng);
// (4) Mixed Poisson: one intensity for the whole plane, drawn from a gamma distribution of that mean and coefficient
// of variation.
std::vector<Point> mixed_points(const Window& window, double intensity, double variation, Rng& rng);
// Poisson points of an intensity that varies: `intensity` times the density.
std::vector<Point> density_points(const Window& window, double intensity, const Density& density, Rng& rng);
// Blue noise: no two points nearer than `distance`, and hardly room for another (Bridson 2007).
std::vector<Point> blue_noise_points(const Window& window, double distance, Rng& rng);

}  // namespace tessera

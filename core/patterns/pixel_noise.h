// Patterns as pixels: Gaussian processes (3.1), colours that vary within a cell, and the mean filter (fig. 3).
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/rng.h"
#include "tessera/geometry/raster.h"
#include "tessera/patterns/colours.h"
#include "tessera/points/window.h"

namespace tessera::patterns {

// A colour a pixel of the window, from the top left. White noise, each pixel of a class of its own; with a
// correlation > 0, px, the first class alone, its colours alike over that distance (exp(-d^2 / (2 correlation^2))).
std::vector<Levels> pixel_colours(const ColourModel& model, double correlation, const Window& window, Rng& rng);

// Noise of the class whose mean is nearest, to each pixel of a picture that has the model's channels.
void add_noise(Raster& picture, const ColourModel& model, std::uint64_t seed);

// The mean of side x side pixels about each; beyond the border comes the border's pixel, of a seamless picture the
// other side's.
void mean_filter(Raster& picture, int side, bool seamless);

}  // namespace tessera::patterns

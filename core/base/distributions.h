// Numbers drawn from the usual distributions, the same ones on every platform.
#pragma once

#include <cstdint>

#include "tessera/base/rng.h"

namespace tessera {

// How many, of mean `mean` >= 0.
std::int64_t draw_poisson(double mean, Rng& rng);
// Mean 0, variance 1.
double draw_normal(Rng& rng);
// Mean 1, variance 1 / shape; shape > 0.
double draw_gamma(double shape, Rng& rng);

}  // namespace tessera

#include "tessera/base/distributions.h"

#include <boost/random/gamma_distribution.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/poisson_distribution.hpp>

namespace tessera {

std::int64_t draw_poisson(double mean, Rng& rng) {
  return mean > 0 ? boost::random::poisson_distribution<std::int64_t, double>(mean)(rng) : 0;
}

double draw_normal(Rng& rng) { return boost::random::normal_distribution<double>()(rng); }

double draw_gamma(double shape, Rng& rng) { return boost::random::gamma_distribution<double>(shape, 1 / shape)(rng); }

}  // namespace tessera

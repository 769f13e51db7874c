#include "tessera/patterns/driving_points.h"

#include <algorithm>
#include <cmath>

#include "tessera/patterns/voronoi_cells.h"
#include "tessera/points/processes.h"

namespace tessera::patterns {
namespace {

constexpr double kPacking = 0.68;  // points that Bridson's method puts into a square as wide as their distance

// Dark places have many points, white ones none; 1 on average, so that the number stays.
Density density_of(const ImageView& picture, const Window& window) {
  Density density{window, picture.width, picture.height, {}};
  double sum = 0;
  for (int y = 0; y < picture.height; ++y) {
    const std::uint8_t* row = picture.pixels + y * picture.stride;
    for (int x = 0; x < picture.width; ++x, row += 3) {
      const int levels = row[0] + row[1] + row[2];
      density.values.push_back(1 - levels / 765.0);
      sum += density.values.back();
    }
  }
  const double mean = sum / static_cast<double>(density.values.size());
  if (mean > 0)
    for (double& v : density.values) v /= mean;
  return density;
}

}  // namespace

std::vector<Point> driving_points(const ImageView& picture, const Params& p, const Window& window, double reach,
                                  Rng& rng) {
  const double intensity = driving_intensity(p);
  const Window realm = window.periodic ? window : window.grown(reach);
  if (intensity <= 0) return {};
  switch (p.process) {
    case Process::kPoisson: break;
    case Process::kBinomial: return binomial_points(realm, intensity, p.grid, rng);
    case Process::kCluster: return cluster_points(realm, intensity, p.family, p.spread, rng);
    case Process::kMatern1: return matern1_points(realm, intensity, p.inhibition, rng);
    case Process::kMatern2: return matern2_points(realm, intensity, p.inhibition, rng);
    case Process::kMixed: return mixed_points(realm, intensity, p.mixing, rng);
    case Process::kCox: {
      if (picture.pixels) return density_points(realm, intensity, density_of(picture, window), rng);
      Rng field(rng.bits(), RngPurpose::kIntensity);
      return density_points(realm, intensity, log_gaussian_density(realm, p.field_scale, p.field_deviation, field),
                            rng);
    }
    case Process::kBlueNoise: return blue_noise_points(realm, std::sqrt(kPacking / intensity), rng);
  }
  return poisson_points(realm, intensity, rng);
}

double reach_of_cells(const Params& p) {
  const double driving = driving_intensity(p), plain = voronoi_reach(driving);
  switch (p.process) {
    case Process::kCluster: return voronoi_reach(driving * (1 - std::exp(-p.family))) + 6 * p.spread;
    // A void of the driving points, about which the next ones may be gone.
    case Process::kMatern1:
    case Process::kMatern2: return 2 * plain + 4 * p.inhibition;
    case Process::kMixed: return 3 * plain;
    case Process::kCox: return plain * std::exp(1.5 * std::min(p.field_deviation, 1.0));
    case Process::kBinomial: return plain + 2 * p.grid;
    default: return plain;
  }
}

}  // namespace tessera::patterns

#include "tessera/patterns/params.h"

#include "tessera/base/portable_math.h"

namespace tessera::patterns {
namespace {

constexpr double kJohnsonMehl = 0.8794;  // cells an area where the rate and the speed are 1

// Points of the process that each point of the driving one makes, or leaves.
double yield(const Params& p, double driving) {
  const double disc = 4 * kPi * p.inhibition * p.inhibition;
  switch (p.process) {
    case Process::kCluster: return p.family;
    case Process::kMatern1: return std::exp(-disc * driving);
    case Process::kMatern2: return disc * driving > 1e-9 ? (1 - std::exp(-disc * driving)) / (disc * driving) : 1;
    default: return 1;
  }
}

// The driving intensity that makes a process of this one, or the most there can be.
double driving_for(const Params& p, double intensity) {
  const double disc = 4 * kPi * p.inhibition * p.inhibition;
  switch (p.process) {
    case Process::kCluster: return p.family > 0 ? intensity / p.family : 0;
    case Process::kMatern1: {
      if (disc * intensity >= std::exp(-1.0)) return 1 / disc;
      double driving = intensity;  // of alpha = intensity exp(disc alpha), from below
      for (int k = 0; k < 200; ++k) driving = intensity * std::exp(disc * driving);
      return driving;
    }
    case Process::kMatern2: {
      constexpr double kNearlyFull = 0.99;  // of a plane to which no point could be added
      return disc > 0 ? -std::log(1 - std::min(disc * intensity, kNearlyFull)) / disc : intensity;
    }
    default: return intensity;
  }
}

}  // namespace

double driving_intensity(const Params& p) {
  if (p.intensity >= 0) return p.intensity;
  const double cells = 1 / (p.size * p.size);
  switch (p.model) {
    case Model::kPoissonLines: return std::sqrt(cells / kPi);
    case Model::kJohnsonMehl: return p.speed * std::pow(cells / kJohnsonMehl, 1.5);
    case Model::kDelaunay: return driving_for(p, cells / 2);
    default: return driving_for(p, cells);
  }
}

double expected_pieces(const Params& p) {
  const double area = p.width * p.height, driving = driving_intensity(p);
  switch (p.model) {
    case Model::kPoissonLines: return kPi * driving * driving * area + driving * 2 * (p.width + p.height);
    case Model::kJohnsonMehl: return kJohnsonMehl * std::pow(driving / p.speed, 2.0 / 3) * area;
    case Model::kCheckerboard: return area / (p.size * p.size);
    case Model::kHexagon: return area / (2.598 * p.size * p.size);
    case Model::kTriangle: return area / (0.433 * p.size * p.size);
    case Model::kGaussian: return area;
    case Model::kDelaunay: return 2 * area * driving * yield(p, driving);
    default: return area * driving * yield(p, driving);
  }
}

}  // namespace tessera::patterns

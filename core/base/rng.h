// Random numbers: the same ones on every platform and standard library.
#pragma once

#include <cstdint>
#include <random>

namespace tessera {

// One stream a purpose: a step that draws more numbers does not disturb another step. Purposes are stable numbers,
// since a job's bytes depend on them.
enum class RngPurpose : std::uint32_t {
  kSites = 1,
  kShapes = 2,
  kNoise = 3,
  kColours = 4,
  kPrototypes = 5,
  kScatter = 6,
  kIntensity = 7,
  kPixels = 8
};

// A generator of random bits to the distributions of Boost.Random, which are the same everywhere; the standard's
// differ between libraries, its engines do not.
class Rng {
 public:
  using result_type = std::uint32_t;
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return 0xffffffff; }
  result_type operator()() { return bits(); }

  Rng(std::uint64_t seed, RngPurpose purpose) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(purpose)};
    engine_.seed(sequence);
  }

  // Uniform in [0, 1), with 53 random bits.
  double uniform() {
    const std::uint64_t high = engine_() >> 5;
    const std::uint64_t low = engine_() >> 6;
    return static_cast<double>(high * 67108864 + low) * (1.0 / 9007199254740992.0);
  }
  // Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_()); }

 private:
  std::mt19937 engine_;
};

}  // namespace tessera

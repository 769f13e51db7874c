#include "tessera/base/rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace tessera {
namespace {

constexpr RngPurpose kPurposes[] = {RngPurpose::kSites, RngPurpose::kShapes, RngPurpose::kNoise,
                                    RngPurpose::kColours};

std::vector<std::uint32_t> first_bits(std::uint64_t seed, RngPurpose purpose, int count) {
  Rng rng(seed, purpose);
  std::vector<std::uint32_t> bits;
  for (int i = 0; i < count; ++i) bits.push_back(rng.bits());
  return bits;
}

// Every job's bytes depend on these: std::seed_seq and std::mt19937 are the same in every standard library.
TEST(Rng, FirstNumbersAreTheKnownOnes) {
  EXPECT_EQ(first_bits(1, RngPurpose::kSites, 4),
            (std::vector<std::uint32_t>{3116378334u, 88650702u, 3696304874u, 1148931858u}));
  EXPECT_EQ(first_bits(0x123456789abcdef0, RngPurpose::kColours, 4),
            (std::vector<std::uint32_t>{2675222986u, 264389923u, 1037490611u, 789926702u}));
}

TEST(Rng, UniformTakes53BitsOfTwoDraws) {
  Rng bits(7, RngPurpose::kShapes), uniform(7, RngPurpose::kShapes);
  for (int i = 0; i < 1000; ++i) {
    const double high = bits.bits() >> 5, low = bits.bits() >> 6;
    ASSERT_EQ(uniform.uniform(), std::ldexp(high * 67108864 + low, -53));
  }
}

TEST(Rng, UniformFillsTheUnitIntervalEvenly) {
  constexpr int kDraws = 100000, kBins = 20;
  for (const RngPurpose purpose : kPurposes) {
    Rng rng(42, purpose);
    std::vector<int> histogram(kBins, 0);
    double sum = 0;
    for (int i = 0; i < kDraws; ++i) {
      const double v = rng.uniform();
      ASSERT_GE(v, 0);
      ASSERT_LT(v, 1);
      ++histogram[static_cast<int>(v * kBins)];
      sum += v;
    }
    EXPECT_NEAR(sum / kDraws, 0.5, 5 / std::sqrt(12.0 * kDraws));
    const double expected = static_cast<double>(kDraws) / kBins;
    for (const int n : histogram) EXPECT_NEAR(n, expected, 5 * std::sqrt(expected));
  }
}

TEST(Rng, UniformKeepsToItsRange) {
  Rng rng(5, RngPurpose::kNoise);
  for (int i = 0; i < 10000; ++i) {
    const double v = rng.uniform(-3, 5);
    ASSERT_GE(v, -3);
    ASSERT_LT(v, 5);
  }
  EXPECT_EQ(rng.uniform(2, 2), 2);
}

TEST(Rng, EveryPurposeAndEveryBitOfTheSeedMakesAnotherStream) {
  std::set<std::vector<std::uint32_t>> streams;
  for (const RngPurpose purpose : kPurposes) streams.insert(first_bits(0, purpose, 4));
  for (int bit = 0; bit < 64; ++bit) streams.insert(first_bits(std::uint64_t{1} << bit, RngPurpose::kSites, 4));
  EXPECT_EQ(streams.size(), 4u + 64u);
}

TEST(Rng, OneStreamDoesNotDisturbAnother) {
  Rng alone(9, RngPurpose::kShapes), sites(9, RngPurpose::kSites), shapes(9, RngPurpose::kShapes);
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < i % 5; ++k) sites.uniform();
    ASSERT_EQ(shapes.bits(), alone.bits());
  }
}

TEST(Rng, StreamsOfTwoPurposesAreUncorrelated) {
  constexpr int kDraws = 20000;
  Rng a(11, RngPurpose::kSites), b(11, RngPurpose::kShapes);
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) sum += (a.uniform() - 0.5) * (b.uniform() - 0.5);
  EXPECT_LT(std::fabs(sum / kDraws), 5.0 / 12 / std::sqrt(kDraws));
}

}  // namespace
}  // namespace tessera

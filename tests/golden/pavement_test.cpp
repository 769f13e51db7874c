// One small job, vertex by vertex: whoever changes the pavement's geometry shall know it.
#include <gtest/gtest.h>

#include <cstdint>

#include "../unit/pavement/drawings.h"
#include "sheet_hash.h"
#include "tessera/pavement/run.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::pavement {
namespace {

constexpr std::uint64_t kExpected = 0x15e5e1f702c1c5f9;

TEST(PavementGolden, TheWaveIsPavedAsBefore) {
  const cv::Mat3b drawing = wave_drawing(96, 64);
  const auto rasterizer = make_cpu_rasterizer();
  const auto output = run(view_of(drawing), {}, 1, *rasterizer, {});
  ASSERT_TRUE(output);
  const std::uint64_t hash = hash_of(output->sheet);
  EXPECT_EQ(hash, kExpected)
      << "The stones have changed (there are " << output->sheet.pieces.size()
      << "). If that is meant, look at the result and write\n  constexpr std::uint64_t kExpected = 0x" << std::hex
      << hash << ";\nin tests/golden/pavement_test.cpp.";
}

}  // namespace
}  // namespace tessera::pavement

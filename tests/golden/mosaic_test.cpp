// One small job, vertex by vertex: whoever changes a mosaic's geometry shall know it. The same number on every
// target.
#include <gtest/gtest.h>

#include <cstdint>

#include "../unit/mosaic/photos.h"
#include "sheet_hash.h"
#include "tessera/mosaic/run.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::mosaic {
namespace {

constexpr std::uint64_t kExpected = 0x548e6f3786dc48d4;

TEST(MosaicGolden, TheDiscIsLaidAsBefore) {
  const cv::Mat3b photo = disc_photo();
  const auto rasterizer = make_cpu_rasterizer();
  Params params;
  params.tiles = 300;
  const auto output = run({view_of(photo), {}, {}, {}}, params, 1, *rasterizer, {});
  ASSERT_TRUE(output);
  const std::uint64_t hash = hash_of(output->sheet);
  EXPECT_EQ(hash, kExpected)
      << "The tiles have changed (there are " << output->sheet.pieces.size()
      << "). If that is meant, look at the result and write\n  constexpr std::uint64_t kExpected = 0x" << std::hex
      << hash << ";\nin tests/golden/mosaic_test.cpp.";
}

}  // namespace
}  // namespace tessera::mosaic

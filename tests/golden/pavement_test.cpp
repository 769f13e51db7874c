// One small job, vertex by vertex: whoever changes the pavement's geometry shall know it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "../unit/pavement/drawings.h"
#include "tessera/pavement/run.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::pavement {
namespace {

constexpr std::uint64_t kExpected = 0x6a43e0c3327e0d64;

// FNV-1a, 64 bits.
class Hash {
 public:
  void add(std::int64_t value) {
    for (int i = 0; i < 8; ++i) {
      hash_ ^= static_cast<std::uint64_t>(value) >> (8 * i) & 255;
      hash_ *= 0x100000001b3;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

// Colours, and vertices rounded to hundredths of a pixel.
std::uint64_t hash_of(const PieceSheet& sheet) {
  Hash hash;
  for (const Piece& stone : sheet.pieces) {
    hash.add(stone.fill.r << 16 | stone.fill.g << 8 | stone.fill.b);
    hash.add(static_cast<std::int64_t>(stone.outline.outer.size()));
    for (const Point p : stone.outline.outer) {
      hash.add(std::llround(p.x * 100));
      hash.add(std::llround(p.y * 100));
    }
  }
  return hash.value();
}

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

// One small photo, outline by outline: whoever changes what is found shall know it. The same number on every target.
#include <gtest/gtest.h>

#include <cstdint>

#include "../unit/image_views.h"
#include "../unit/pebbles/beach.h"
#include "sheet_hash.h"
#include "tessera/pebbles/run.h"

namespace tessera::pebbles {
namespace {

void expect_hash(Segmenter segmenter, std::uint64_t expected, const char* name) {
  const Beach beach = paint_beach(6, 4, 7);
  Params params;
  params.segmenter = segmenter;
  const auto output = run({view_of(beach.photo), {}}, params, 1, {});
  ASSERT_TRUE(output);
  const std::uint64_t hash = hash_of(output->sheet);
  EXPECT_EQ(hash, expected) << "The outlines by " << name << " have changed (there are " << output->pebbles.size()
                            << "). If that is meant, look at the result and write 0x" << std::hex << hash
                            << " in tests/golden/pebbles_test.cpp.";
}

TEST(PebblesGolden, TheTreeFindsWhatItFoundBefore) { expect_hash(Segmenter::kTree, 0x8238167aeb414745, "the tree"); }
TEST(PebblesGolden, TheRaysFindWhatTheyFoundBefore) { expect_hash(Segmenter::kRays, 0xc79aefeb732fad14, "rays"); }

}  // namespace
}  // namespace tessera::pebbles

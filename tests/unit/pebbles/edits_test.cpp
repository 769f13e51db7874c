// Corrections: how they are read, and what they do to labels.
#include "tessera/pebbles/edits.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <vector>

#include "labels.h"

namespace tessera::pebbles {
namespace {

std::vector<Edit> edits_of(std::string_view text) {
  std::vector<Edit> edits;
  EXPECT_TRUE(parse_edits(text, edits));
  return edits;
}

// The labels after the edits; all of them have an effect.
cv::Mat1i edited(std::string_view text, cv::Mat1i labels, double scale = 1) {
  const std::vector<Edit> edits = edits_of(text);
  EXPECT_EQ(apply_edits(edits, scale, labels), static_cast<int>(edits.size()));
  return labels;
}

bool same(const cv::Mat1i& a, const cv::Mat1i& b) { return a.size() == b.size() && cv::countNonZero(a != b) == 0; }

TEST(Edits, AreRead) {
  EXPECT_TRUE(edits_of(" ;\n# nothing").empty());
  const std::vector<Edit> four =
      edits_of("merge 120,44  130.5,60; ;split 1,2 3,4\n# by hand\r\ndelete 5,8;add 1,1 9,1 5,7");
  ASSERT_EQ(four.size(), 4u);
  EXPECT_EQ(four[0].kind, Edit::Kind::kMerge);
  ASSERT_EQ(four[0].points.size(), 2u);
  EXPECT_EQ(four[0].points[1], (Point{130.5, 60}));
  EXPECT_EQ(four[1].kind, Edit::Kind::kSplit);
  EXPECT_EQ(four[2].kind, Edit::Kind::kDelete);
  EXPECT_EQ(four[2].points[0], (Point{5, 8}));
  EXPECT_EQ(four[3].kind, Edit::Kind::kAdd);
  EXPECT_EQ(four[3].points.size(), 3u);
}

TEST(Edits, AreRefused) {
  std::vector<Edit> edits;
  for (const char* wrong : {"merge", "merge 1,2", "split 3,4", "delete", "add 1,1 2,2", "erase 1,2", "delete 1",
                            "delete 1,2,3", "delete a,b", "delete 1,nan", "Delete 1,2", "delete 1,2; merge 4,4"})
    EXPECT_FALSE(parse_edits(wrong, edits)) << wrong;
}

TEST(Edits, MergedOnesTakeTheGapBetweenThem) {
  EXPECT_TRUE(same(edited("merge 1,1 5,1", labels_of({"1110222", "1110222", "1110222"})),
                   labels_of({"1111111", "1111111", "1111111"})));
  // What lies in between and is another's stays that other's.
  EXPECT_TRUE(same(edited("merge 5,1 1,1", labels_of({"1110222", "1113222", "1110222"})),
                   labels_of({"2222222", "2223222", "2222222"})));
}

TEST(Edits, SplitOnesAreDividedHalfWay) {
  EXPECT_TRUE(same(edited("split 0.5,0.5 7.5,0.5", labels_of({"11111111", "02211110"})),
                   labels_of({"11113333", "02213330"})));
  EXPECT_TRUE(same(edited("split 0.5,0.5 4.5,0.5 8.5,0.5", labels_of({"111111111"})), labels_of({"111222233"})));
}

TEST(Edits, DeletedOnesAreGround) {
  EXPECT_TRUE(same(edited("delete 0,0 4,1", labels_of({"11022", "11033"})), labels_of({"00022", "00000"})));
}

TEST(Edits, AddedOnesGetANewLabel) {
  EXPECT_TRUE(same(edited("add 1,0 4,0 4,2 1,2", labels_of({"00000", "00002", "00000"})),
                   labels_of({"03330", "03332", "00000"})));
}

TEST(Edits, PointsAreSourcePixels) {
  EXPECT_TRUE(same(edited("delete 16,0", labels_of({"11022", "11022"}), 0.25), labels_of({"11000", "11000"})));
}

TEST(Edits, ThatHitNothingDoNothing) {
  const cv::Mat1i before = labels_of({"11022", "11022"});
  cv::Mat1i labels = before.clone();
  EXPECT_EQ(
      apply_edits(edits_of("delete 2,0; delete -4,0; delete 99,99; merge 0,0 1,1; merge 0,0 2,1; split 0,0 4,0; "
                           "split 2,0 2,1; add 50,50 60,50 55,60"),
                  1, labels),
      0);
  EXPECT_TRUE(same(labels, before));
}

TEST(Edits, KeepAllPixelsOfOthers) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed, RngPurpose::kShapes);
    cv::Mat1i labels(30, 40);
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x) labels(y, x) = x % 10 == 0 || y % 10 == 0 ? 0 : 1 + x / 10 + 4 * (y / 10);
    const cv::Mat1i before = labels.clone();
    const auto inside = [&rng](int end) { return below(rng, end / 10) * 10 + 1 + below(rng, 9); };
    const Point p{inside(40) + 0.5, inside(30) + 0.5}, q{inside(40) + 0.5, inside(30) + 0.5};
    const auto kind = seed % 2 == 0 ? Edit::Kind::kMerge : Edit::Kind::kDelete;
    apply_edits({{kind, {p, q}}}, 1, labels);
    const std::set<int> meant{before(static_cast<int>(p.y), static_cast<int>(p.x)),
                              before(static_cast<int>(q.y), static_cast<int>(q.x))};
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x)
        if (before(y, x) != 0 && meant.count(before(y, x)) == 0) {
          ASSERT_EQ(labels(y, x), before(y, x)) << seed;
        }
  }
}

}  // namespace
}  // namespace tessera::pebbles

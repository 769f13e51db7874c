#include "tessera/parquetry/panel_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::parquetry {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<std::string> complaints(const std::string& text) {
  std::vector<std::string> all;
  read_panel_options(text, [&](std::string message) { all.push_back(std::move(message)); });
  return all;
}

TEST(PanelOptions, ReadsWhatPeopleWrite) {
  const std::string text = "oak dpi=300 margin=5;\n walnut  machine=10:10,160.5:-10,10:110 ; fir";
  EXPECT_THAT(complaints(text), IsEmpty());
  const auto all = read_panel_options(text);
  ASSERT_THAT(all, SizeIs(3));
  EXPECT_EQ(all[0].name, "oak");
  EXPECT_EQ(all[0].dpi, 300);
  EXPECT_EQ(all[0].margin_mm, 5);
  ASSERT_THAT(all[1].machine, SizeIs(3));
  EXPECT_EQ(all[1].machine[1].x, 160.5);
  EXPECT_EQ(all[1].machine[1].y, -10);
  EXPECT_EQ(all[2].dpi, 0);
  EXPECT_THAT(read_panel_options(""), IsEmpty());
}

TEST(PanelOptions, MarksMayBeAnyNumber) {
  EXPECT_FALSE(read_panel_options("oak dpi=300")[0].marks.has_value());
  EXPECT_THAT(*read_panel_options("oak marks=1:2")[0].marks, SizeIs(1));
  EXPECT_THAT(complaints("oak marks=none"), IsEmpty());
  EXPECT_THAT(*read_panel_options("oak marks=none")[0].marks, IsEmpty());
  EXPECT_THAT(complaints("oak marks=").front(), HasSubstr("places x:y,x:y or none"));
  EXPECT_THAT(complaints("oak marks=none machine=1:1,2:2,3:3").front(), HasSubstr("as many"));
}

TEST(PanelOptions, SaysEverythingThatIsWrong) {
  const auto all = complaints("oak dpi=0 margin=-1 colour=red; oak; a.b; fir machine=1:2,3:4 marks=1:1,2:2,3:x");
  ASSERT_THAT(all, SizeIs(7));
  EXPECT_THAT(all[0], HasSubstr("dpi=0"));
  EXPECT_THAT(all[1], HasSubstr("margin=-1"));
  EXPECT_THAT(all[2], HasSubstr("dpi, margin, marks or machine"));
  EXPECT_THAT(all[3], HasSubstr("twice"));
  EXPECT_THAT(all[4], HasSubstr("a.b"));
  EXPECT_THAT(all[5], HasSubstr("three or more"));
  EXPECT_THAT(complaints("oak marks=1:1,2:2,3:3 machine=1:1,2:2,3:3,4:4").front(), HasSubstr("as many"));
}

TEST(PanelOptions, NamesArePlainWords) {
  for (const char* good : {"oak", "A-1", "_", "panel_2"}) EXPECT_TRUE(is_panel_name(good)) << good;
  for (const char* bad : {"", "a b", "../x", "ü", "a.b", "a/b"}) EXPECT_FALSE(is_panel_name(bad)) << bad;
  EXPECT_TRUE(is_panel_name(std::string(40, 'a')));
  EXPECT_FALSE(is_panel_name(std::string(41, 'a')));
}

}  // namespace
}  // namespace tessera::parquetry

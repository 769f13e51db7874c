#include "tessera/base/text.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

using Words = std::vector<std::string_view>;

TEST(Split, GivesTheWordsBetweenSeparators) {
  EXPECT_EQ(split(" a, bc,,d ", " ,"), (Words{"a", "bc", "d"}));
  EXPECT_EQ(split("", " ,"), Words{});
  EXPECT_EQ(split(" ,, ", " ,"), Words{});
  EXPECT_EQ(split("whole", ","), Words{"whole"});
}

TEST(ParseColour, TakesThreeOrSixDigits) {
  Rgb colour{1, 2, 3};
  for (const char* wrong : {"", "#", "#12345", "#1234567", "red", "#12345g", "-12345", "# 12345"}) {
    EXPECT_FALSE(parse_colour(wrong, colour)) << wrong;
    EXPECT_EQ(colour, (Rgb{1, 2, 3}));
  }
  EXPECT_TRUE(parse_colour("#aB01ff", colour));
  EXPECT_EQ(colour, (Rgb{0xab, 0x01, 0xff}));
  EXPECT_TRUE(parse_colour("18f", colour));
  EXPECT_EQ(colour, (Rgb{0x11, 0x88, 0xff}));
}

TEST(ParseNumber, TakesDecimalsOnly) {
  double value = 7;
  for (const char* wrong : {"", "a", "1a", "nan", "inf", "0x10", "1e999", "--1", "1 "}) {
    EXPECT_FALSE(parse_number(wrong, value)) << wrong;
    EXPECT_EQ(value, 7);
  }
  EXPECT_TRUE(parse_number("-1.5e2", value));
  EXPECT_EQ(value, -150);
}

}  // namespace
}  // namespace tessera

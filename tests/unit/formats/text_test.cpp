#include "tessera/formats/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "tessera/base/rng.h"

namespace tessera {
namespace {

std::string number(double value) {
  std::string out;
  append_number(out, value);
  return out;
}

std::string by_printf(double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.3f", value);
  std::string text = buffer;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string xml(std::string_view text) {
  std::string out;
  append_xml(out, text);
  return out;
}

TEST(AppendNumber, ExactTexts) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(-0.0004), "0");
  EXPECT_EQ(number(0.0006), "0.001");
  EXPECT_EQ(number(-0.0006), "-0.001");
  EXPECT_EQ(number(0.9996), "1");
  EXPECT_EQ(number(1.5), "1.5");
  EXPECT_EQ(number(10), "10");
  EXPECT_EQ(number(100.01), "100.01");
  EXPECT_EQ(number(-1000.1), "-1000.1");
  EXPECT_EQ(number(1000000), "1000000");
  EXPECT_EQ(number(1002003.004), "1002003.004");
  EXPECT_EQ(number(999999999999.0), "999999999999");
  EXPECT_EQ(number(1234567890123.25), "1234567890123.25");
  EXPECT_EQ(number(-1e15), "-1000000000000000");
  EXPECT_EQ(number(1e18), "1000000000000000000");
  EXPECT_EQ(number(1e-300), "0");
  EXPECT_EQ(number(std::numeric_limits<double>::denorm_min()), "0");
}

TEST(AppendNumber, AllThousandthsAsPrintf) {
  for (int i = -20000; i <= 20000; ++i) ASSERT_EQ(number(i / 1000.0), by_printf(i / 1000.0)) << i;
}

TEST(AppendNumber, ManyMagnitudesAsPrintf) {
  Rng rng(1, RngPurpose::kNoise);
  for (int i = 0; i < 200000; ++i) {
    const double value = rng.uniform(-1, 1) * std::pow(10, rng.uniform(-5, 9));
    ASSERT_EQ(number(value), by_printf(value)) << value;
  }
}

TEST(AppendNumber, Appends) {
  std::string out = "x=";
  append_point(out, {1.25, -2}, ',');
  append_integer(out, -42);
  EXPECT_EQ(out, "x=1.25,-2-42");
}

#if !defined(NDEBUG) && defined(GTEST_HAS_DEATH_TEST)
TEST(AppendNumber, RefusesWhatIsNoNumber) {
  EXPECT_DEATH(number(std::nan("")), "");
  EXPECT_DEATH(number(std::numeric_limits<double>::infinity()), "");
}
#endif

TEST(AppendColour, Hexadecimal) {
  std::string out;
  append_colour(out, {0, 171, 255});
  EXPECT_EQ(out, "#00abff");
}

TEST(AppendXml, EscapesMarkupAndReplacesWhatXmlForbids) {
  EXPECT_EQ(xml("{\"a\":\"</metadata>&amp;]]>\"}"), "{\"a\":\"&lt;/metadata&gt;&amp;amp;]]&gt;\"}");
  EXPECT_EQ(xml("cal\xC3\xA7"
                "ada\n\t"),
            "cal\xC3\xA7"
            "ada\n\t");
  EXPECT_EQ(xml(std::string_view("a\0b\x1F", 4)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
  EXPECT_EQ(xml("\xEF\xBF\xBE|\xEF\xBF\xBF|\xEF\xBF"), "\xEF\xBF\xBD|\xEF\xBF\xBD|\xEF\xBF");
}

}  // namespace
}  // namespace tessera

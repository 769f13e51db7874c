#include "tessera/job/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "tessera/job/techniques.h"

namespace tessera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> fields_of(const Problems& problems) {
  std::vector<std::string> fields;
  for (const Status& problem : problems) fields.push_back(problem.field);
  return fields;
}

Problems problems_of(const Json& object) {
  TechniqueParams params;
  Problems problems;
  read_params(object, params, problems);
  return problems;
}

// The message of the only problem there is.
std::string message_of(const Json& object) {
  const Problems problems = problems_of(object);
  EXPECT_EQ(problems.size(), 1u) << object;
  return problems.empty() ? "" : problems.front().message;
}

TEST(ParametersTest, EveryDescriptionIsComplete) {
  for (const Technique& technique : techniques()) {
    std::set<std::string> keys;
    for (const Parameter& parameter : parameters_of(technique.defaults)) {
      const ParameterInfo& info = parameter.info;
      SCOPED_TRACE(info.key);
      EXPECT_TRUE(keys.insert(info.key).second) << "named twice";
      EXPECT_STRNE(info.help, "");
      EXPECT_EQ(std::string(info.help).find('\n'), std::string::npos);
      EXPECT_LE(info.min, info.ui_min);
      EXPECT_LE(info.ui_min, info.ui_max);
      EXPECT_LE(info.ui_max, info.max);
      EXPECT_EQ(complaint(parameter, parameter.value), std::nullopt) << "the default is not valid";
    }
  }
}

TEST(ParametersTest, WritesWhatItReads) {
  for (const Technique& technique : techniques()) {
    const Json defaults = write_params(technique.defaults);
    const auto goes_round = [&](const Json& changed) {
      TechniqueParams params = technique.defaults;
      Problems problems;
      read_params(changed, params, problems);
      EXPECT_TRUE(problems.empty()) << changed;
      EXPECT_EQ(write_params(params), changed);
    };
    Json largest = defaults;
    for (const Parameter& parameter : parameters_of(technique.defaults)) {
      Json& value = largest[parameter.info.key];
      if (value.is_number()) value = tidy_number(parameter.info.max);
    }
    EXPECT_NE(largest, defaults);
    goes_round(largest);
    // One by one: not all choices go together.
    for (const Parameter& parameter : parameters_of(technique.defaults))
      for (const auto& choice : parameter.choices) {
        Json changed = defaults;
        changed[parameter.info.key] = choice.name;
        goes_round(changed);
      }
  }
}

TEST(ParametersTest, MissingKeysKeepTheirValue) {
  TechniqueParams params = pavement::Params{.half_side = 9};
  Problems problems;
  read_params({{"grout", 2}}, params, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(std::get<pavement::Params>(params).half_side, 9);
  EXPECT_EQ(std::get<pavement::Params>(params).grout, 2);
}

TEST(ParametersTest, SaysWhatWasExpected) {
  EXPECT_EQ(message_of({{"halfSide", 0.2}}), "is 0.2, expected 1 to 512 px");
  EXPECT_EQ(message_of({{"halfSide", "four"}}), "is \"four\", expected a number, 1 to 512 px");
  EXPECT_EQ(message_of({{"halfSide", nullptr}}), "is null, expected a number, 1 to 512 px");
  EXPECT_EQ(message_of({{"colors", 2.5}}), "is 2.5, expected a whole number, 2 to 16");
  EXPECT_EQ(message_of({{"colors", 1}}), "is 1, expected 2 to 16");
  EXPECT_EQ(message_of({{"method", "fast"}}), "is \"fast\", expected flow or paper");
  EXPECT_EQ(message_of({{"method", 3}}), "is 3, expected flow or paper");
  EXPECT_THAT(message_of({{"halfsize", 3}}), HasSubstr("is no parameter of pavement, expected halfSide, "));
}

TEST(ParametersTest, TakesWholeNumbersHoweverTheyAreWritten) {
  EXPECT_TRUE(problems_of({{"colors", 4.0}}).empty());
  EXPECT_TRUE(problems_of({{"halfSide", 4}}).empty());
}

TEST(ParametersTest, RefusesWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double value : {nan, inf, -inf}) {
    EXPECT_THAT(message_of({{"halfSide", value}}), HasSubstr("expected a number, 1 to 512 px"));
    EXPECT_THAT(message_of({{"iterations", value}}), HasSubstr("expected a whole number, 0 to 1000"));
  }
  EXPECT_EQ(message_of({{"sites", 1e300}}), "is 1e+300, expected 0 to 4194304");
  EXPECT_EQ(message_of({{"sites", std::numeric_limits<std::int64_t>::min()}}),
            "is -9223372036854775808, expected 0 to 4194304");
}

TEST(ParametersTest, ReportsAllProblemsInTheirOrder) {
  const Problems problems = problems_of({{"halfSide", 0}, {"nonsense", 1}, {"colors", "x"}, {"grout", 1}});
  EXPECT_THAT(fields_of(problems), ElementsAre("halfSide", "nonsense", "colors"));
  for (const Status& problem : problems) EXPECT_EQ(problem.code, StatusCode::kInvalidParameter);
}

TEST(ParametersTest, ChecksFieldsTogetherOnceEachIsValid) {
  EXPECT_THAT(fields_of(problems_of({{"stretchMin", 3}, {"stretchMax", 2}})), ElementsAre("stretchMin"));
  EXPECT_THAT(fields_of(problems_of({{"stretchMin", 3}, {"stretchMax", "x"}})), ElementsAre("stretchMax"));
}

TEST(ParametersTest, ChecksStructsToo) {
  Problems problems;
  check_params(pavement::Params{.half_side = std::nan(""), .colors = 99, .method = static_cast<pavement::Method>(7)},
               problems);
  EXPECT_THAT(fields_of(problems), ElementsAre("halfSide", "colors", "method"));
}

TEST(ParametersTest, LongValuesAreCutAndStayOnOneLine) {
  const std::string message = message_of({{"method", std::string(5000, 'x') + "\n"}});
  EXPECT_LT(message.size(), 100u);
  EXPECT_LT(fields_of(problems_of({{std::string(5000, 'k'), 1}})).front().size(), 60u);
  EXPECT_EQ(shown("a\nb\x01"), "\"a\\nb\\u0001\"");
  EXPECT_EQ(shown(Json::array({1, 2})), "a list");
}

TEST(ParametersTest, Words) {
  EXPECT_EQ(kebab_case("halfSide"), "half-side");
  EXPECT_EQ(kebab_case("grout"), "grout");
  EXPECT_EQ(either_of({"a"}), "a");
  EXPECT_EQ(either_of({"a", "b"}), "a or b");
  EXPECT_EQ(either_of({"a", "b", "c"}), "a, b or c");
  EXPECT_EQ(range_text({.min = 1, .max = 2.5, .unit = "mm"}), "1 to 2.5 mm");
  EXPECT_EQ(range_text({.min = 1}), "at least 1");
  EXPECT_EQ(range_text({.max = 0.5, .unit = "px"}), "at most 0.5 px");
  EXPECT_EQ(range_text({}), "");
}

}  // namespace
}  // namespace tessera

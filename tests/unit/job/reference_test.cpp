#include "tessera/job/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using ::testing::HasSubstr;

TEST(ReferenceTest, SchemaSaysWhatTheParametersSay) {
  for (const Technique& technique : techniques()) {
    const Json schema = params_schema(technique);
    EXPECT_EQ(schema["additionalProperties"], false);
    const auto parameters = parameters_of(technique.defaults);
    ASSERT_EQ(schema["properties"].size(), parameters.size());
    for (const Parameter& parameter : parameters) {
      SCOPED_TRACE(parameter.info.key);
      const Json& property = schema["properties"][parameter.info.key];
      EXPECT_EQ(property["default"], parameter.value);
      EXPECT_EQ(property["description"], parameter.info.help);
      EXPECT_EQ(property.contains("enum"), parameter.kind == ParameterKind::kChoice);
      if (property.contains("minimum")) {
        EXPECT_EQ(property["minimum"].get<double>(), parameter.info.min);
        EXPECT_EQ(property["x-ui-maximum"].get<double>(), parameter.info.ui_max);
      }
    }
  }
}

TEST(ReferenceTest, PavementAsAnExample) {
  const Json property = params_schema(*find_technique("pavement"))["properties"]["halfSide"];
  EXPECT_EQ(
      property.dump(),
      R"({"title":"Half side","description":"Half the side of a stone","type":"number","minimum":1,"maximum":512,)"
      R"("x-ui-minimum":2,"x-ui-maximum":24,"default":4,"x-unit":"px","x-symbol":"h"})");
}

TEST(ReferenceTest, JobSchemaHoldsEveryTechnique) {
  const Json schema = job_schema();
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["oneOf"].size(), techniques().size());
  for (const Technique& technique : techniques()) {
    EXPECT_TRUE(schema["$defs"].contains(std::string(technique.name)));
  }
}

TEST(ReferenceTest, MarkdownNamesEveryFlag) {
  const std::string text = parameter_reference();
  for (const Technique& technique : techniques()) {
    for (const Parameter& parameter : parameters_of(technique.defaults)) {
      EXPECT_THAT(text, HasSubstr("| `--" + kebab_case(parameter.info.key) + "` |"));
    }
  }
}

}  // namespace
}  // namespace tessera

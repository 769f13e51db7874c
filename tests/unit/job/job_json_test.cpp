#include "tessera/job/job_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Job sample_job() {
  return {.seed = kMaxSeed, .params = pavement::Params{.half_side = 6.5}, .inputs = {{"drawing", "a \"b\" <ü>.png"}}};
}

// The first problem of a text that is no job.
Status refusal(std::string_view text) {
  const auto job = read_job(text);
  EXPECT_FALSE(job.has_value()) << text.substr(0, 80);
  return job ? Status{} : job.error().front();
}

std::string svg_with(const std::string& metadata) {
  return "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\">" + metadata +
         "<path d=\"M0 0\"/></svg>\n";
}

TEST(JobJsonTest, ReadsWhatItWrites) {
  for (const Layout layout : {Layout::kOneLine, Layout::kIndented}) {
    const std::string text = job_to_text(sample_job(), layout);
    const auto job = read_job(text);
    ASSERT_TRUE(job.has_value());
    EXPECT_EQ(job_to_text(*job, layout), text);
    EXPECT_EQ(job->seed, kMaxSeed);
    EXPECT_EQ(job->inputs, sample_job().inputs);
  }
  EXPECT_EQ(job_to_text(sample_job()).find('\n'), std::string::npos);
}

TEST(JobJsonTest, NamesItsMembersInOrder) {
  std::vector<std::string> keys;
  const Json json = job_to_json(sample_job());
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("schemaVersion", "technique", "seed", "params", "inputs"));
}

TEST(JobJsonTest, DefaultsWhatIsNotSaid) {
  const auto job = read_job(R"({"schemaVersion": 1, "technique": "pavement"})");
  ASSERT_TRUE(job.has_value());
  EXPECT_EQ(job_to_text(*job), job_to_text(Job{}));
}

TEST(JobJsonTest, ReportsAllProblems) {
  const auto job = read_job(R"({"schemaVersion": 2, "technique": "pavement", "sede": 3, "seed": -1,
      "params": {"halfSide": 0, "x": 1}, "inputs": {"photo": "a.png", "drawing": 7}})");
  ASSERT_FALSE(job.has_value());
  std::vector<std::string> fields;
  for (const Status& problem : job.error()) {
    EXPECT_EQ(problem.code, StatusCode::kInvalidParameter);
    fields.push_back(problem.field);
  }
  EXPECT_THAT(fields, ElementsAre("sede", "schemaVersion", "seed", "halfSide", "x", "photo", "drawing"));
}

TEST(JobJsonTest, RefusesWrongMembers) {
  EXPECT_EQ(refusal(R"({"technique": "pavement"})").message, "is missing, expected 1");
  EXPECT_EQ(refusal(R"({"schemaVersion": 1})").message,
            "is missing, expected pavement, mosaic, pebbles, pattern or parquetry");
  EXPECT_EQ(refusal(R"({"schemaVersion": 1, "technique": "cheese"})").message,
            "is \"cheese\", expected pavement, mosaic, pebbles, pattern or parquetry");
  EXPECT_EQ(refusal(R"({"schemaVersion": 1, "technique": ["pavement"]})").message,
            "is a list, expected pavement, mosaic, pebbles, pattern or parquetry");
  EXPECT_EQ(refusal(R"({"schemaVersion": 1, "technique": "pavement", "seed": 9007199254740992})").field, "seed");
  EXPECT_EQ(refusal(R"({"schemaVersion": 1, "technique": "pavement", "seed": 1.5})").field, "seed");
  EXPECT_EQ(refusal(R"({"schemaVersion": 1, "technique": "pavement", "params": []})").field, "params");
  EXPECT_EQ(refusal(R"({"schemaVersion": 1, "technique": "pavement", "inputs": "a.png"})").field, "inputs");
}

TEST(JobJsonTest, SaysWhereJsonBreaks) {
  const Status status = refusal("{\n  \"schemaVersion\": 1,\n  technique\n}");
  EXPECT_EQ(status.code, StatusCode::kInvalidInput);
  EXPECT_THAT(status.message, HasSubstr("line 3, column "));
}

TEST(JobJsonTest, RefusesHostileText) {
  const std::vector<std::string> texts = {
      "",
      "   ",
      "null",
      "[]",
      "\"job\"",
      "{",
      "{}x",
      std::string("\0\0\0", 3),
      "{\"seed\": 1e400}",
      "{\"seed\": \"\xFF\xFE\"}",
      "{\"schemaVersion\": 1, \"schemaVersion\": 1, \"technique\": \"pavement\"}",
      std::string(kMaxJobBytes, ' ') + "{}",
      std::string(200'000, '['),
      "{\"a\":" + std::string(100, '[') + std::string(100, ']') + "}",
  };
  for (const std::string& text : texts) {
    const Status status = refusal(text);
    EXPECT_TRUE(status.code == StatusCode::kInvalidInput || status.code == StatusCode::kInvalidParameter);
    EXPECT_EQ(status.message.find('\n'), std::string::npos);
    EXPECT_LT(status.message.size(), 300u);
  }
  EXPECT_THAT(refusal(texts[10]).message, HasSubstr("\"schemaVersion\" twice"));
}

TEST(JobJsonTest, BracketsInTextsAreNoDepth) {
  Job job = sample_job();
  job.inputs["drawing"] = std::string(100, '[') + "\\\"" + std::string(100, '{');
  EXPECT_TRUE(read_job(job_to_text(job)).has_value());
}

TEST(JobJsonTest, PathsThatAreNotUtf8AreWrittenAllTheSame) {
  Job job = sample_job();
  job.inputs["drawing"] = "caf\xE9.png";
  EXPECT_TRUE(read_job(job_to_text(job)).has_value());
}

TEST(JobSvgTest, ReadsTheJobOfAnSvg) {
  const std::string plain = job_to_text(sample_job());
  const std::string escaped =
      "{&quot;schemaVersion&quot;:1,&#34;technique&#x22;:&quot;pavement&quot;,\"inputs\":{\"drawing\":\"&lt;&amp;&#"
      "xFC;&gt;&apos;\"}}";
  const auto job = read_job(svg_with("<metadata>" + escaped + "</metadata>"));
  ASSERT_TRUE(job.has_value());
  EXPECT_EQ(job->inputs.at("drawing"), "<&ü>'");
  const auto in_cdata = read_job(svg_with("<metadata id='a>b'><![CDATA[" + plain + "]]></metadata>"));
  ASSERT_TRUE(in_cdata.has_value());
  EXPECT_EQ(job_to_text(*in_cdata), plain);
}

TEST(JobSvgTest, LooksPastOtherMarkup) {
  const std::string job = "{\"schemaVersion\":1,\"technique\":\"pavement\"}";
  const std::vector<std::string> svgs = {
      svg_with("<!-- <metadata>{}</metadata> --><metadata>" + job + "</metadata>"),
      svg_with("<metadata/><metadata><rdf:RDF>{\"no\":1}</rdf:RDF></metadata><metadata>" + job + "</metadata>"),
      svg_with("<svg:metadata>\n " + job + " <rdf:RDF><x/></rdf:RDF>\n</svg:metadata>"),
      svg_with("<desc a=\"<metadata>\">{</desc><metadata>" + job + "</metadata>"),
      "\xEF\xBB\xBF \n<!DOCTYPE svg PUBLIC \"a\" \"b\">" + svg_with("<metadata>" + job + "</metadata>"),
  };
  for (const std::string& svg : svgs) {
    const auto found = read_job(svg);
    EXPECT_TRUE(found.has_value()) << svg << ": " << found.error().front().message;
  }
}

TEST(JobSvgTest, RefusesSvgsWithoutAJob) {
  const std::vector<std::string> svgs = {
      svg_with(""),
      svg_with("<metadata></metadata>"),
      svg_with("<metadata>words</metadata>"),
      svg_with("<metadata>{&lol;}</metadata>"),
      svg_with("<metadata>{&#xD800;}</metadata>"),
      svg_with("<metadata>{&#99999999999;}</metadata>"),
      svg_with("<metadata>{&#;}</metadata>"),
      svg_with("<metadata>{&amp}</metadata>"),
      svg_with("<metadata>{"),
      svg_with("<metadata>" + std::string(kMaxJobBytes + 1, ' ') + "{}</metadata>"),
      "<!DOCTYPE svg [<!ENTITY a \"b\">]><svg><metadata>{}</metadata></svg>",
      "<svg><metadata",
      "<svg a='>",
      "<",
      "<!",
      "<!--",
      "<metadata>{}",
  };
  for (const std::string& svg : svgs) {
    EXPECT_EQ(refusal(svg).code, StatusCode::kInvalidInput) << svg.substr(0, 80);
  }
}

// Cutting an SVG anywhere gives an answer, and a job only where the whole of it is there.
TEST(JobSvgTest, SurvivesBeingCut) {
  const std::string svg = svg_with("<metadata>{&quot;schemaVersion&quot;:1,\"technique\":\"pavement\"}</metadata>");
  const std::size_t end = svg.find("</metadata>") + std::string("</metadata>").size();
  for (std::size_t size = 0; size <= svg.size(); ++size) {
    EXPECT_EQ(read_job(std::string_view(svg).substr(0, size)).has_value(), size >= end) << size;
  }
}

TEST(JobJsonTest, RolesOfManyPicturesHaveNames) {
  const std::string start = R"({"schemaVersion": 1, "technique": "parquetry", "inputs": {"target": "t.png", )";
  const auto job = read_job(start + R"("panel-oak": "o.jpg", "mask-oak": "m.png", "panel-fir_2": "f.jpg"}})");
  ASSERT_TRUE(job.has_value());
  EXPECT_EQ(job->inputs.at("panel-fir_2"), "f.jpg");
  EXPECT_EQ(job_to_text(*read_job(job_to_text(*job))), job_to_text(*job));
  for (const char* wrong : {"panel", "panel-", "panel-a b", "panel-../x", "mask", "oak"}) {
    const Status status = refusal(start + '"' + wrong + "\": \"o.jpg\"}}");
    EXPECT_THAT(status.message, HasSubstr("expected target, target-NAME, segmentation, edge-mask, panel-NAME or mask-NAME"))
        << wrong;
  }
}

}  // namespace
}  // namespace tessera

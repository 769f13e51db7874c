#include "tessera/job/measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/formats/formats.h"
#include "tessera/job/job_json.h"
#include "tessera/patterns/run.h"

namespace tessera {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view bytes) {
  const auto file = read_pattern_file(bytes);
  return file ? "" : file.error().message;
}

PieceSheet sheet_of(patterns::Model model, double size = 12) {
  patterns::Params params;
  params.model = model;
  params.width = 300;
  params.height = 240;
  params.size = size;
  return patterns::run({}, params, 1, {})->sheet;
}

TEST(PatternFileTest, ReadsWhatTheWritersWrite) {
  for (const patterns::Model model : {patterns::Model::kOccupancy, patterns::Model::kPoints}) {
    const PieceSheet sheet = sheet_of(model);
    for (const std::string& bytes : {write_geojson(sheet), write_svg(sheet)}) {
      const auto file = read_pattern_file(bytes);
      ASSERT_TRUE(file.has_value()) << file.error().message;
      EXPECT_EQ(file->window.high.x, 300);
      EXPECT_EQ(file->window.high.y, 240);
      EXPECT_EQ(file->cells.size(), sheet.points ? 0 : sheet.pieces.size());
      EXPECT_EQ(file->points.size(), sheet.points ? sheet.pieces.size() : 0);
    }
    const auto table = read_pattern_file(write_csv(sheet));
    ASSERT_TRUE(table.has_value());
    ASSERT_EQ(table->points.size(), sheet.pieces.size());
    const Point centre = centroid(sheet.pieces[7].outline.outer);
    EXPECT_NEAR(table->points[7].x, centre.x, 1e-3);
    EXPECT_NEAR(table->points[7].y, centre.y, 1e-3);
  }
}

TEST(PatternFileTest, ReadsListsAndTables) {
  EXPECT_EQ(read_pattern_file("[[1,2],[3,4.5]]")->points[1].y, 4.5);
  EXPECT_EQ(read_pattern_file("1,2\n3,4\n")->points.size(), 2u);
  EXPECT_EQ(read_pattern_file("name,y,x\na,1,2\n")->points[0].x, 2);
  EXPECT_EQ(read_pattern_file("x_mm;y_mm\r\n1;2\r\n")->points[0].y, 2);
}

TEST(PatternFileTest, RefusesWhatIsNone) {
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("{"), HasSubstr("JSON"));
  EXPECT_THAT(refusal("{}"), HasSubstr("FeatureCollection"));
  EXPECT_THAT(refusal("[]"), HasSubstr("neither cells nor points"));
  EXPECT_THAT(refusal("[[1]]"), HasSubstr("entry 1"));
  EXPECT_THAT(refusal("[[1,2],[1e300,0]]"), HasSubstr("entry 2"));
  EXPECT_THAT(refusal("x,y\n1,2\n3,cheese\n"), HasSubstr("line 3"));
  EXPECT_THAT(refusal("cheese"), HasSubstr("neither"));
  EXPECT_THAT(refusal("<svg><path d=\"M0 0C1 1 2 2 3 3Z\"/></svg>"), HasSubstr("path 1"));
  EXPECT_THAT(refusal(R"({"features":[{"geometry":{"type":"LineString","coordinates":[]}}]})"),
              HasSubstr("feature 1"));
  EXPECT_THAT(refusal(R"({"features":[{"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,1]]]}}]})"),
              HasSubstr("feature 1"));
  EXPECT_THAT(refusal(R"({"features":[7]})"), HasSubstr("feature 1"));
  EXPECT_THAT(refusal(R"({"features":[{"geometry":{"type":5,"coordinates":[1,2]}}]})"), HasSubstr("feature 1"));
  EXPECT_THAT(refusal(R"({"features":[{"geometry":{"coordinates":[1,2]}}]})"), HasSubstr("feature 1"));
  EXPECT_THAT(refusal("<svg><path d=\"M0 0L9 0L9 9Z\"/><path class=\"point\" d=\"M0 0L9 0L9 9Z\"/></svg>"),
              HasSubstr("both cells and points"));
  EXPECT_THAT(refusal(std::string(100000, '[')), HasSubstr("JSON"));
}

// The job inside an SVG says with which closed form to compare.
TEST(MeasureTest, CellsStandBesideTheirModelsClosedForm) {
  Job job{.seed = 1, .params = patterns::Params{}, .inputs = {}};
  auto& params = std::get<patterns::Params>(job.params);
  params.width = params.height = 700;
  params.size = 14;
  for (const patterns::Model model : {patterns::Model::kOccupancy, patterns::Model::kCheckerboard}) {
    params.model = model;
    PieceSheet sheet = patterns::run({}, params, 1, {})->sheet;
    sheet.job_json = job_to_text(job);
    const auto measured = measure_pattern(*read_pattern_file(write_svg(sheet)), {}, {});
    ASSERT_TRUE(measured.has_value());
    const Json& json = measured->json;
    EXPECT_EQ(json["kind"], "cells");
    EXPECT_EQ(json["comparison"]["model"], model == patterns::Model::kOccupancy ? "occupancy" : "checkerboard");
    EXPECT_EQ(json["cells"], sheet.pieces.size());
    EXPECT_NEAR(json["area"]["mean"].get<double>() / json["area"]["expected"].get<double>(), 1, 0.05);
    EXPECT_NEAR(json["sides"]["mean"].get<double>(), json["sides"]["expected"].get<double>(), 0.1);
    for (const Json& entry : json["same_cell"])
      EXPECT_NEAR(entry["value"].get<double>(), entry["expected"].get<double>(), 0.025) << entry.dump();
    ASSERT_EQ(measured->plots.size(), 3u);
    EXPECT_THAT(write_plot(measured->plots[0]), HasSubstr("closed form"));
    // All cells of a lattice are alike, which is the one closed form of areas.
    const auto& areas = std::get<Curves>(measured->plots[1].figure);
    const auto& points = areas.series[0].points;
    EXPECT_EQ(areas.series.size(), model == patterns::Model::kCheckerboard ? 2u : 1u);
    EXPECT_NEAR(points.back().y, 1, 1e-9);
    for (std::size_t i = 1; i < points.size(); ++i) EXPECT_GE(points[i].y, points[i - 1].y);
    // The area above the distribution is the mean.
    double mean = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      mean += (points[i].x - points[i - 1].x) * (1 - (points[i].y + points[i - 1].y) / 2);
    EXPECT_NEAR(mean / json["area"]["mean"].get<double>(), 1, 0.02) << mean;
    const auto& sides = std::get<Histogram>(measured->plots[2].figure);
    EXPECT_EQ(sides.bins[0], "3");
    EXPECT_NEAR(std::accumulate(sides.series[0].values.begin(), sides.series[0].values.end(), 0.0), 1, 1e-9);
    EXPECT_THAT(measured->csv, testing::StartsWith("d,same_cell,expected\n"));
  }
}

TEST(MeasureTest, PicturesStandBesideAModelsClosedForm) {
  patterns::Params params;
  params.width = params.height = 900;
  params.size = 18;
  const PieceSheet sheet = patterns::run({}, params, 2, {})->sheet;
  const Raster raster = draw_sheet(sheet);
  MeasureOptions options;
  options.comparison = Comparison{statistics::CellModel::kOccupancy, 1.0 / (18 * 18)};
  options.distances = {6, 12, 24, 48};
  const auto measured = measure_picture({raster.bytes.data(), 900, 900, 2700}, options, {});
  ASSERT_TRUE(measured.has_value());
  EXPECT_EQ(measured->json["classes"].size(), 4u);
  for (const Json& entry : measured->json["needles"])
    EXPECT_NEAR(entry["same_cell"].get<double>(), entry["expected"].get<double>(), 0.035) << entry["d"];
}

TEST(MeasureTest, PointsStandBesidePoisson) {
  const auto measured =
      measure_pattern(*read_pattern_file(write_geojson(sheet_of(patterns::Model::kPoints, 4))), {}, {});
  ASSERT_TRUE(measured.has_value());
  EXPECT_EQ(measured->json["kind"], "points");
  EXPECT_NEAR(measured->json["intensity"].get<double>(), 1.0 / 16, 0.004);
  EXPECT_NEAR(measured->json["nearest_mean"].get<double>() / measured->json["nearest_poisson"].get<double>(), 1,
              0.05);
  for (const Json& entry : measured->json["ripley"]) {
    if (entry["t"] <= 3) continue;
    EXPECT_NEAR(entry["k"].get<double>() / entry["poisson"].get<double>(), 1, 0.1) << entry.dump();
  }
}

TEST(MeasureTest, OptionsAreReadOrAllTheirProblemsTold) {
  const auto fields = [](const Json& json) {
    std::vector<std::string> names;
    const auto options = read_measure_options(json);
    if (!options)
      for (const Status& problem : options.error()) names.push_back(problem.field);
    return names;
  };
  const auto options = read_measure_options({{"model", "hexagon"}, {"lambda", 7}, {"window", {30, 20}}, {"seed", 3}});
  ASSERT_TRUE(options.has_value());
  EXPECT_EQ(options->comparison->model, statistics::CellModel::kHexagon);
  EXPECT_EQ(options->comparison->x, 7);
  EXPECT_EQ(options->height, 20);
  EXPECT_EQ(options->seed, 3u);
  EXPECT_THAT(fields(Json::object()), testing::IsEmpty());
  EXPECT_THAT(fields(nullptr), testing::ElementsAre("options"));
  EXPECT_THAT(fields({{"model", 7}, {"colors", 1}, {"needles", 0.5}, {"seed", -1}}),
              testing::ElementsAre("model", "lambda", "needles", "colors", "seed"));
  EXPECT_THAT(fields({{"distances", {1, 0}}, {"window", {1, 2, 3}}}), testing::ElementsAre("distances", "window"));
  EXPECT_THAT(fields({{"seed", nullptr}, {"distances", "cheese"}}), testing::ElementsAre("distances", "seed"));
}

TEST(MeasureTest, CellsStopWhenTheyAreToldTo) {
  std::atomic<int> stop{0};
  RunContext context;
  context.stop = &stop;
  context.on_progress = [&](double) { stop = 1; };
  const auto measured =
      measure_pattern(*read_pattern_file(write_geojson(sheet_of(patterns::Model::kHexagon))), {}, context);
  ASSERT_FALSE(measured.has_value());
  EXPECT_EQ(measured.error().code, StatusCode::kCancelled);
}

TEST(MeasureTest, RefusesWhatHasNoSize) {
  EXPECT_FALSE(measure_picture({}, {}, {}).has_value());
  EXPECT_FALSE(measure_pattern(*read_pattern_file("[[1,1]]"), {}, {}).has_value());
  EXPECT_FALSE(measure_pattern(*read_pattern_file("[[1,1],[2,1],[3,1]]"), {}, {}).has_value());
}

}  // namespace
}  // namespace tessera

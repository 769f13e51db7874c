// CSV and GeoJSON: what they say of the pieces.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "sheets.h"
#include "tessera/formats/formats.h"
#include "tessera/formats/measures.h"

namespace tessera {
namespace {

Ring ring_of(const nlohmann::json& positions) {
  Ring ring;
  for (const auto& p : positions) ring.push_back({p[0].get<double>(), p[1].get<double>()});
  return ring;
}

TEST(Measures, HolesCount) {
  const Measures m = measure({{{0, 0}, {10, 0}, {10, 4}, {0, 4}}, {{{6, 1}, {8, 1}, {8, 3}, {6, 3}}}});
  EXPECT_DOUBLE_EQ(m.area, 36);
  EXPECT_DOUBLE_EQ(m.perimeter, 36);
  EXPECT_EQ(m.vertices, 8U);
  EXPECT_DOUBLE_EQ(m.centroid.x, (40 * 5 - 4 * 7) / 36.0);
  EXPECT_DOUBLE_EQ(m.centroid.y, 2);
  EXPECT_EQ(m.orientation, 0);
}

TEST(Measures, OrientationNeverRoundsTo180) {
  const double tilt = 1e-6;
  EXPECT_EQ(measure({{{0, tilt}, {10, 0}, {10, 4}, {0, 4 + tilt}}, {}}).orientation, 0);
}

TEST(WriteCsv, ExactText) {
  EXPECT_EQ(write_csv(two_stones()),
            "id,colour,area_px2,perimeter_px,vertices,orientation_deg,centroid_x,centroid_y\n"
            "stone-1,#000000,74.375,34.5,4,90,4.75,4.625\n"
            "stone-17,#fffa0a,58,42,8,0,14.052,5.103\n");
}

TEST(WriteCsv, OneRowAPiece) {
  std::istringstream lines(write_csv(random_sheet(3, 12)));
  std::set<std::string> ids;
  int rows = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 7) << line;
    ids.insert(line.substr(0, line.find(',')));
  }
  EXPECT_EQ(rows, 1 + 144);
  EXPECT_EQ(ids.size(), 1U + 144);
}

TEST(WriteGeojson, ExactText) {
  EXPECT_EQ(write_geojson(two_stones()),
            R"({"type":"FeatureCollection","bbox":[0,0,20,10],"features":[
{"type":"Feature","properties":{"id":"stone-1","colour":"#000000","area":74.375,"vertices":4,"orientation":90,"centroid":[4.75,4.625]},"geometry":{"type":"Polygon","coordinates":[[[0.5,0.25],[9,0.25],[9,9],[0.5,9],[0.5,0.25]]]}},
{"type":"Feature","properties":{"id":"stone-17","colour":"#fffa0a","area":58,"vertices":8,"orientation":0,"centroid":[14.052,5.103]},"geometry":{"type":"Polygon","coordinates":[[[10,1],[18,1],[18,9],[10,9],[10,1]],[[12,3],[12,5],[15,5],[15,3],[12,3]]]}}
]}
)");
}

TEST(WriteGeojson, EmptySheetIsACollectionWithoutFeatures) {
  PieceSheet sheet = two_stones();
  sheet.pieces.clear();
  const auto json = nlohmann::json::parse(write_geojson(sheet));
  EXPECT_EQ(json["type"], "FeatureCollection");
  EXPECT_TRUE(json["features"].is_array());
  EXPECT_TRUE(json["features"].empty());
}

TEST(WriteGeojson, RingsAreClosedAndTurnAsRfc7946SaysOverManySeeds) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    PieceSheet sheet = random_sheet(seed, 6);
    for (std::size_t i = 0; i < sheet.pieces.size(); i += 2) {  // half of them the other way round
      std::reverse(sheet.pieces[i].outline.outer.begin(), sheet.pieces[i].outline.outer.end());
      for (Ring& hole : sheet.pieces[i].outline.holes) std::reverse(hole.begin(), hole.end());
    }
    const auto json = nlohmann::json::parse(write_geojson(sheet));
    ASSERT_EQ(json["features"].size(), sheet.pieces.size());
    for (std::size_t i = 0; i < sheet.pieces.size(); ++i) {
      const auto& feature = json["features"][i];
      const auto& rings = feature["geometry"]["coordinates"];
      const Polygon& outline = sheet.pieces[i].outline;
      ASSERT_EQ(rings.size(), 1 + outline.holes.size());
      for (std::size_t r = 0; r < rings.size(); ++r) {
        EXPECT_EQ(rings[r].front(), rings[r].back());
        Ring ring = ring_of(rings[r]);
        ring.pop_back();
        EXPECT_EQ(ring.size(), (r == 0 ? outline.outer : outline.holes[r - 1]).size());
        EXPECT_EQ(signed_area(ring) > 0, r == 0);
      }
      EXPECT_EQ(feature["properties"]["id"], "tile-" + std::to_string(sheet.pieces[i].id));
      EXPECT_NEAR(feature["properties"]["area"].get<double>(), area(outline), 0.0006);
      EXPECT_EQ(feature["properties"]["vertices"], measure(outline).vertices);
    }
  }
}

}  // namespace
}  // namespace tessera

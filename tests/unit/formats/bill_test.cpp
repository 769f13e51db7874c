#include <gtest/gtest.h>

#include "tessera/formats/formats.h"

namespace tessera {
namespace {

Piece square(int id, double side, Rgb fill) { return {id, {{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}}, fill}; }

TEST(BillCsv, CountsAndMeasuresEachColourTheLargestAreaFirst) {
  PieceSheet sheet;
  sheet.width = 100;
  sheet.height = 50;
  sheet.pieces = {square(1, 2, {1, 2, 3}), square(2, 4, {255, 0, 0}), square(3, 2, {1, 2, 3})};
  sheet.materials = {{"brick, \"old\"", {255, 0, 0}}};
  EXPECT_EQ(write_bill_csv(sheet),
            "colour,name,count,area_px2,area_mm2,share\n"
            "#ff0000,\"brick, \"\"old\"\"\",1,16,,0.667\n"
            "#010203,,2,8,,0.333\n");
  sheet.width_mm = 200;
  EXPECT_NE(write_bill_csv(sheet).find(",1,16,64,0.667\n"), std::string::npos);
}

TEST(BillCsv, OfNothingIsAHeader) { EXPECT_EQ(write_bill_csv({}), "colour,name,count,area_px2,area_mm2,share\n"); }

}  // namespace
}  // namespace tessera

#include "tessera/job/parquet_folder.h"

#include <fmt/format.h>

#include <utility>

#include "tessera/formats/formats.h"
#include "tessera/formats/text.h"
#include "tessera/job/parameters.h"
#include "tessera/parquetry/cut_sheets.h"
#include "tessera/parquetry/previews.h"

namespace tessera {

std::string pieces_csv(const Parquetry& made) {
  std::string out = "id,row,column,target,panel,x_mm,y_mm,rotation_deg,area_mm2,min_width_mm,cost,grain_deg\n";
  for (const parquetry::CutPiece& piece : made.pieces) {
    out += piece.id;
    for (const int number : {piece.row, piece.column, piece.target}) {
      out += ',';
      append_integer(out, number);
    }
    out += ',';
    out += made.panels[piece.panel].name;
    for (const double number :
         {piece.centroid_mm.x, piece.centroid_mm.y, piece.turn_deg, piece.area_mm2, piece.min_width_mm}) {
      out += ',';
      append_number(out, number);
    }
    out += ',';
    append_integer(out, piece.cost);
    out += ',';
    append_number(out, piece.grain_deg);
    out += '\n';
  }
  return out;
}

std::vector<Artifact> parquet_folder(const Parquetry& made) {
  constexpr const char* kSvg = "image/svg+xml";
  constexpr const char* kPng = "image/png";
  std::vector<Artifact> files = {
      {"job.json", "application/json", Json::parse(made.job_json).dump(2) + "\n"},
      {"pieces.csv", "text/csv", pieces_csv(made)},
  };
  const auto drawn = [&](Drawing drawing) {
    drawing.job_json = made.job_json;
    return drawing;
  };
  for (std::size_t i = 0; i < made.targets.size(); ++i) {
    const int target = static_cast<int>(i) + 1;
    files.push_back({target == 1 ? std::string("preview.png") : fmt::format("preview-{}.png", target), kPng,
                     write_png(parquetry::finished_preview(made.panels, made.pieces, target, made.targets[i]))});
  }
  files.push_back({"assembly.svg", kSvg,
                   write_svg(drawn(parquetry::assembly(made.pieces, made.missing, made.targets, made.mm_per_px(),
                                                       made.params)))});
  for (std::size_t i = 0; i < made.panels.size(); ++i) {
    const std::string stem = "panel-" + made.panels[i].name;
    const Drawing drawing = drawn(parquetry::cut_sheet(made.panels, i, made.pieces, made.params).drawing);
    files.push_back({stem + ".cut.svg", kSvg, write_svg(drawing)});
    files.push_back({stem + ".cut.dxf", "image/vnd.dxf", write_dxf(drawing)});
    files.push_back({stem + ".preview.png", kPng, write_png(parquetry::panel_preview(made.panels, i, made.pieces))});
  }
  return files;
}

}  // namespace tessera

// The files that a parquetry job ends in.
#pragma once

#include <string>
#include <vector>

#include "tessera/job/job.h"
#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/pieces.h"

namespace tessera {

// Everything about a finished parquetry.
struct Parquetry {
  parquetry::Params params;
  std::vector<parquetry::Panel> panels;
  std::vector<parquetry::CutPiece> pieces;
  std::vector<parquetry::MissingPiece> missing;
  std::vector<cv::Size> targets;  // their sizes, px
  std::string job_json;           // in one line

  double mm_per_px() const { return panels.front().mm_per_px; }
};

// job.json, preview.png (of further targets preview-2.png and so on), pieces.csv, assembly.svg, and
// panel-NAME.cut.svg, .cut.dxf and .preview.png of each panel.
std::vector<Artifact> parquet_folder(const Parquetry& made);

// id,row,column,target,panel,x_mm,y_mm,rotation_deg,area_mm2,min_width_mm,cost,grain_deg
std::string pieces_csv(const Parquetry& made);

}  // namespace tessera

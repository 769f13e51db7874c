// What a parquetry takes, before it is made.
#pragma once

#include <string>
#include <vector>

#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

// Adaptive patches only make more of them.
struct Plan {
  int targets = 0, pieces = 0;
  int rows = 0, columns = 0;           // of one target, where there is just one; the most columns of a row;
  double width_mm = 0, height_mm = 0;  // of the finished piece, too
  double wood_mm2 = 0;                 // of all pieces
  double taken_mm2 = 0;                // the same with kerf and clearance around each
  double cut_mm = 0;                   // all outlines
  double minutes = 0;                  // of cutting, at cutSpeed
};
// Of the wood by a patch, with kerf and clearance; what is in a hole is not to be had any more.
double taken_mm2(const Patch& patch, const Params& params, double mm_per_px);
double plan_mm_per_px(const Params& params);  // that of panels of 150 dpi, where resolutionDpi says nothing
// `targets`: at least one; `patches` cover them.
Plan plan_of(const std::vector<cv::Size>& targets, const std::vector<Patch>& patches, const Params& params,
             double mm_per_px);
std::string describe(const Plan& plan, const Params& params);

const char* tone_name(int level);  // "light" of 255

// Wood and target of one range of brightness, averaged over the area of a patch.
struct ToneSupply {
  const char* name;
  double needed_mm2 = 0;  // taken by the targets' patches of that tone, after w_hist has moved them
  double free_mm2 = 0;
};

struct Forecast {
  Plan plan;
  std::vector<double> free_mm2;  // a panel
  std::vector<ToneSupply> tones;
  double free() const;
};
// Whether the panels suffice. What is free is not all usable: between pieces that do not fill a panel wood is left.
// `targets`: at the panels' resolution; `patches` cover them.
Forecast forecast_of(const std::vector<cv::Mat3b>& targets, const std::vector<Patch>& patches,
                     const std::vector<Panel>& panels, const Params& params);
std::string describe(const Forecast& forecast, const std::vector<Panel>& panels, const Params& params);

}  // namespace tessera::parquetry

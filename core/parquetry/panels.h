// Scans become panels.
#pragma once

#include <string>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/image/image_view.h"
#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/params.h"

namespace tessera::parquetry {

struct Scan {
  std::string name;
  ImageView picture;
  ImageView mask{};  // white: wood; without pixels the picture's alpha or what find_wood() sees
};

inline constexpr double kUnknownDpi = 300;  // of a scan of which nobody says it

// The scans at one resolution (3.1), with masks, markers and their place on the machine, in the order given. Warns
// of resolutions that are guesses. kInvalidInput, with the panel's name, for a mask of other proportions, for panels
// without wood, and for marks that are too few or do not fit.
Result<std::vector<Panel>> take_in(const std::vector<Scan>& scans, const Params& params, const RunContext& context);

// The same before anything is taken off the masks, and not laid on the machine: what has been found on the scans.
// Panels without wood are no error.
Result<std::vector<Panel>> look_at(const std::vector<Scan>& scans, const Params& params, const RunContext& context);

// Their resolution, which that of the targets is, too.
double mm_per_px_of(const std::vector<Scan>& scans, const Params& params);

// A place on the panel (px, front) on the sheet that the cutter gets, mm: mirrored where it cuts from the back, and
// moved to where the panel lies.
Point on_sheet(const Panel& panel, Side side, Point px);

}  // namespace tessera::parquetry

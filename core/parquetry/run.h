// Matching: targets and panels in, a piece of wood for each patch out (3.2, 3.3), cut where it fits best (3.4).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/parquetry/assign.h"
#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

struct Request {
  std::vector<cv::Mat3b> targets;  // RGB, at the panels' resolution: at_resolution() in patches.h
  std::vector<Patch> patches;      // that cover them: grid_patches() of each, for example
  bool interleaved = false;        // patches of all targets in one order; else target by target
  // What an earlier run of the same request laid before it was stopped, in its order, as the observer was told; the
  // result is that of an unbroken run. Whole calls of the observer: all quarters of a patch, or none.
  std::vector<Laid> earlier;
  // Whether to go on improving after all are laid; asked before each try. Empty: do not.
  std::function<bool()> improve;
};

struct Output {
  // Row by row, target by target; quarters in place of what was quartered. With seams their outlines are those of the
  // pieces, which lie in their boxes and share their sides.
  std::vector<Patch> patches;
  std::vector<Placement> placements;  // of each patch; panel -1 where no wood was left
  std::int64_t greedy_cost = 0;       // of all placements, before improving
  std::int64_t cost = 0;              // after
  int quartered = 0;                  // patches
  int without_wood = 0;               // pieces
  int rounds = 0;                     // of improving, laid to their ends
  int exchanges = 0;                  // made by improving
  // Eq. 8: each pixel of the targets with the features of the piece that covers it, none where wood is missing. As
  // the pieces are cut, and as they would be with straight cuts between the same ones.
  std::int64_t reconstruction_cost = 0, straight_cost = 0;
  double seams_moved = 0;  // share of the seams' pixels that had to go back for pieces to be wide enough
};

// Called when a patch has been laid, with its piece or the pieces of its quarters.
using LaidObserver = std::function<void(const std::vector<Laid>& pieces)>;

// At least one panel with pixels; all have one resolution. All parameters are valid; patches lie in their targets.
// Fails with kInvalidInput for `target` or `panel` without pixels, with kInvalidParameter for resolutionDpi where the
// views of the panels would not fit into memory, for seams where patches are not those of the grid, kCancelled or
// kTimeout as `context` says. Stages: features, matching, and with `improve` improving; with seams: seams. The same
// arguments, the same result, for any number of threads; but that improving depends on what `improve` says.
Result<Output> run(const std::vector<Panel>& panels, const Request& request, const Params& params,
                   const RunContext& context, const LaidObserver& observer = {});

}  // namespace tessera::parquetry

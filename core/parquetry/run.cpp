#include "tessera/parquetry/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "tessera/geometry/scan.h"
#include "tessera/parquetry/exchange.h"
#include "tessera/parquetry/features.h"
#include "tessera/parquetry/order.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/rounds.h"
#include "tessera/parquetry/seam_curves.h"
#include "tessera/parquetry/widen.h"

namespace tessera::parquetry {
namespace {

constexpr double kMostBytes = 3.6e9;
constexpr double kSeamsApartMm = 0.75, kAtCrossings = 0.15;  // of minWidthMm

// Of a turned panel: features, fine moments and, per block side, coarse ones; bounds and room.
double bytes_of_views(const std::vector<Panel>& panels, const Params& params) {
  const double channels = feature_channels(params), group = kGroup * kGroup;
  const double sides = std::min(3, 1 + params.adaptive_levels);
  double pixels = 0;
  for (const Panel& panel : panels) pixels += static_cast<double>(panel.scan.total());
  const double views = static_cast<double>(allowed_rotations(params).size());
  constexpr double kBoxes = 1.7;  // a turned panel's box to the panel, on average; some rows have bytes for all of it
  return views * pixels * (channels + (8 * channels + sides * 4 * channels + 3 + 2 * kBoxes) / group);
}

bool are_of_the_grid(const Request& request, const Params& params, double mm_per_px) {
  std::size_t next = 0;
  for (std::size_t target = 0; target < request.targets.size(); ++target)
    for (const Patch& patch :
         grid_patches(request.targets[target].size(), params, mm_per_px, static_cast<int>(target)))
      if (next == request.patches.size() || request.patches[next].target != patch.target ||
          request.patches[next].box != patch.box || request.patches[next++].outline.outer != patch.outline.outer)
        return false;
  return next == request.patches.size();
}

Result<void> check(const std::vector<Panel>& panels, const Request& request, const Params& params) {
  for (const cv::Mat3b& target : request.targets)
    if (target.empty()) return fail(StatusCode::kInvalidInput, "target", "has no pixels; expected at least 1 x 1");
  if (panels.empty()) return fail(StatusCode::kInvalidInput, "panel", "is missing; expected at least one");
  for (const Panel& panel : panels)
    if (panel.scan.empty())
      return fail(StatusCode::kInvalidInput, "panel",
                  fmt::format("{} has no pixels; expected at least 1 x 1", panel.name));
  if (const double bytes = bytes_of_views(panels, params); bytes > kMostBytes)
    return fail(StatusCode::kInvalidParameter, "resolutionDpi",
                fmt::format("the panels in all their rotations would take {:.1f} GB; expected at most {:.1f}: fewer "
                            "rotations, panels or dpi",
                            bytes / 1e9, kMostBytes / 1e9));
  if (params.seams != SeamKind::kNone && !are_of_the_grid(request, params, panels.front().mm_per_px))
    return fail(StatusCode::kInvalidParameter, "seams", "join patches of the grid alone; expected none for others");
  return {};
}

// A patch of the grid, and its quarters.
using Place = std::array<int, 4>;
Place place_of(const Patch& patch) { return {patch.target, patch.row, patch.column, patch.part}; }

Output collected(std::vector<Laid> pieces) {
  // Quarters stay in their order.
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Laid& a, const Laid& b) { return place_of(a.patch) < place_of(b.patch); });
  Output output;
  std::set<Place> quartered;
  for (Laid& laid : pieces) {
    laid.placement.patch = static_cast<int>(output.patches.size());
    if (laid.patch.level > 0) quartered.insert(place_of(laid.patch));
    if (laid.placement.panel < 0) ++output.without_wood;
    output.cost += laid.placement.cost;
    output.patches.push_back(std::move(laid.patch));
    output.placements.push_back(laid.placement);
  }
  output.quartered = static_cast<int>(quartered.size());
  return output;
}

std::int64_t cost_of(const std::vector<Laid>& pieces) {
  std::int64_t sum = 0;
  for (const Laid& laid : pieces) sum += laid.placement.cost;
  return sum;
}

// 3.3: each patch in its order.
Result<std::vector<Laid>> lay_all(Workshop& workshop, const Request& request, const RunContext& context,
                                  const LaidObserver& observer) {
  Greedy greedy(workshop);
  std::vector<Laid> pieces = request.earlier;
  std::set<Place> done;
  for (const Laid& laid : pieces) {
    greedy.lay_again(laid);
    done.insert(place_of(laid.patch));
  }
  const std::vector<int> order =
      order_of(request.patches, request.targets, workshop.params().order, request.interleaved);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Patch& patch = request.patches[order[i]];
    if (done.count(place_of(patch)) == 0) {
      if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
      const std::vector<Laid> laid = greedy.lay(patch);
      if (observer) observer(laid);
      pieces.insert(pieces.end(), laid.begin(), laid.end());
    }
    context.progress(static_cast<double>(i + 1) / static_cast<double>(order.size()));
  }
  return pieces;
}

// The pieces of a target, which are those of the grid.
Reconstruction reconstruction_of(const Workshop& workshop, const Output& output, int target) {
  Reconstruction reconstruction;
  reconstruction.target = workshop.features_of_target(target);
  reconstruction.grid = grid_of(reconstruction.target.size(), workshop.params(), workshop.mm_per_px());
  for (std::size_t i = 0; i < output.patches.size(); ++i)
    if (output.patches[i].target == target)
      reconstruction.pieces.push_back(
          {output.patches[i].box, workshop.features_of_wood({output.patches[i], output.placements[i]})});
  return reconstruction;
}

std::int64_t cost_within(const Ring& outline, const Reconstruction& reconstruction,
                         const Reconstruction::Piece& piece) {
  std::int64_t sum = 0;
  each_run(outline, reconstruction.target.cols, reconstruction.target.rows, [&](int y, int begin, int end) {
    for (int x = begin; x < end; ++x) sum += reconstruction.error(piece, x, y);
  });
  return sum;
}

// 3.4: where patches overlap, their pieces are cut so that the picture gains most.
void cut_seams(const Workshop& workshop, std::size_t targets, Output& output) {
  output.reconstruction_cost = output.straight_cost = 0;
  const Params& params = workshop.params();
  const double mm = workshop.mm_per_px();
  const Joints joints = params.seams == SeamKind::kG1 ? Joints::kG1 : Joints::kG0;
  std::size_t next = 0;
  for (std::size_t target = 0; target < targets; ++target) {
    const Reconstruction reconstruction = reconstruction_of(workshop, output, static_cast<int>(target));
    const Grid& grid = reconstruction.grid;
    const int stray = overlap_of(grid, params, mm).stray;
    const Seams cheapest =
        find_seams(reconstruction, {stray, kAtCrossings * params.min_width_mm / mm, kSeamsApartMm / mm});
    Seams seams = cheapest;
    widen(grid, stray, (params.min_width_mm + params.seam_error_mm) / mm, seams);
    const SeamNetwork network = network_of(grid, seams, params.seam_error_mm / mm, joints);
    for (const Reconstruction::Piece& piece : reconstruction.pieces) {
      Patch& patch = output.patches[next++];
      patch.outline.outer = network.outline(patch.column, patch.row);
      output.reconstruction_cost += cost_within(patch.outline.outer, reconstruction, piece);
    }
    output.straight_cost += cost_of(reconstruction, straight_seams(grid));
    output.seams_moved += share_moved(cheapest, seams) / static_cast<double>(targets);
  }
}

}  // namespace

Result<Output> run(const std::vector<Panel>& panels, const Request& request, const Params& params,
                   const RunContext& context, const LaidObserver& observer) {
  if (auto good = check(panels, request, params); !good) return tl::unexpected(good.error());

  context.stage("features");
  Workshop workshop(panels, request.targets, request.patches, params);
  if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());

  context.stage("matching");
  Result<std::vector<Laid>> pieces = lay_all(workshop, request, context, observer);
  if (!pieces) return tl::unexpected(pieces.error());
  const std::int64_t greedy_cost = cost_of(*pieces);

  int rounds = 0, exchanges = 0;
  if (request.improve) {
    context.stage("improving");
    const auto go_on = [&] { return request.improve() && context.check(); };
    rounds = lay_in_rounds(workshop, *pieces, go_on);
    exchanges = exchange_places(workshop, *pieces, go_on);
    if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
  }
  Output output = collected(std::move(*pieces));
  output.greedy_cost = greedy_cost;
  output.rounds = rounds;
  output.exchanges = exchanges;
  output.reconstruction_cost = output.straight_cost = output.cost;
  if (params.seams != SeamKind::kNone) {
    context.stage("seams");
    cut_seams(workshop, request.targets.size(), output);
  }
  return output;
}

}  // namespace tessera::parquetry

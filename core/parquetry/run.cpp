#include "tessera/parquetry/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "tessera/parquetry/cut_seams.h"
#include "tessera/parquetry/exchange.h"
#include "tessera/parquetry/features.h"
#include "tessera/parquetry/order.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/rounds.h"

namespace tessera::parquetry {
namespace {

constexpr double kMostBytes = 3.6e9;

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

std::set<Place> places_of(const std::vector<Laid>& pieces) {
  std::set<Place> places;
  for (const Laid& laid : pieces) places.insert(place_of(laid.patch));
  return places;
}

// Whether an earlier run has come to the end of it.
bool is_laid(const Request& request) {
  const std::set<Place> done = places_of(request.earlier);
  return !request.earlier.empty() &&
         std::all_of(request.patches.begin(), request.patches.end(),
                     [&](const Patch& patch) { return done.count(place_of(patch)) != 0; });
}

// 3.3: each patch in its order.
Result<std::vector<Laid>> lay_all(Workshop& workshop, const Request& request, const RunContext& context,
                                  const LaidObserver& observer) {
  Greedy greedy(workshop);
  std::vector<Laid> pieces = request.earlier;
  for (const Laid& laid : pieces) greedy.lay_again(laid);
  const std::set<Place> done = places_of(pieces);
  const auto patches = static_cast<double>(request.patches.size());
  if (!done.empty()) context.progress(static_cast<double>(done.size()) / patches);
  const std::vector<int> order =
      order_of(request.patches, request.targets, workshop.params().order, request.interleaved);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Patch& patch = request.patches[order[i]];
    if (done.count(place_of(patch)) != 0) continue;
    if (auto go_on = context.check(); !go_on) return tl::unexpected(go_on.error());
    const std::vector<Laid> laid = greedy.lay(patch);
    if (observer) observer(laid);
    pieces.insert(pieces.end(), laid.begin(), laid.end());
    context.progress(static_cast<double>(i + 1) / patches);
  }
  return pieces;
}

}  // namespace

Result<Output> run(const std::vector<Panel>& panels, const Request& request, const Params& params,
                   const RunContext& context, const LaidObserver& observer) {
  if (auto good = check(panels, request, params); !good) return tl::unexpected(good.error());
  const bool with_seams = params.seams != SeamKind::kNone;
  if (is_laid(request) && !request.improve && !with_seams) {
    Output output = collected(request.earlier);
    output.greedy_cost = output.reconstruction_cost = output.straight_cost = output.cost;
    context.progress(1);
    return output;
  }

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
  if (with_seams) {
    context.stage("seams");
    const SeamCosts costs = cut_seams(workshop, request.targets.size(), output.placements, output.patches);
    output.reconstruction_cost = costs.cut;
    output.straight_cost = costs.straight;
    output.seams_moved = costs.moved;
  }
  return output;
}

}  // namespace tessera::parquetry

#include "tessera/job/parquet_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "tessera/geometry/scan.h"
#include "tessera/job/job_json.h"
#include "tessera/job/parquet_folder.h"
#include "tessera/parquetry/cut_sheets.h"
#include "tessera/parquetry/features.h"
#include "tessera/parquetry/free_patches.h"
#include "tessera/parquetry/panels.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/plan.h"
#include "tessera/parquetry/previews.h"
#include "tessera/parquetry/run.h"
#include "tessera/parquetry/state.h"

namespace tessera {
namespace {

using parquetry::CutPiece;
using parquetry::Panel;
using parquetry::Params;
using parquetry::Placement;

// "target", then "target-2", "target-10": shorter names first; all of them again for each copy.
std::vector<ImageView> targets_of(const Pictures& pictures, const Params& params) {
  const Technique& technique = *find_technique("parquetry");
  std::map<std::pair<std::size_t, std::string>, ImageView> named;
  for (const auto& [input, picture] : pictures) {
    const InputRole* role = role_of(technique, input);
    if (role && role->name == "target") named.emplace(std::pair(input.size(), input), picture);
  }
  std::vector<ImageView> targets;
  for (int copy = 0; copy < params.copies; ++copy)
    for (const auto& [name, picture] : named) targets.push_back(picture);
  return targets;
}

// In the order of their names.
std::vector<parquetry::Scan> scans_of(const Pictures& pictures) {
  const Technique& technique = *find_technique("parquetry");
  std::vector<parquetry::Scan> scans;
  for (const auto& [input, picture] : pictures) {
    const InputRole* role = role_of(technique, input);
    if (!role || role->name != "panel") continue;
    const std::string name(name_in(*role, input));
    scans.push_back({name, picture, picture_of(pictures, "mask-" + name)});
  }
  return scans;
}

parquetry::Drawn drawn_in(const Pictures& pictures) {
  return {picture_of(pictures, "segmentation"), picture_of(pictures, "edge-mask")};
}

// Inputs that do not go together: masks and options of panels that are not there, and two ways to make patches.
Result<void> check_inputs(const Job& job, const Pictures& pictures) {
  const Technique& technique = *find_technique("parquetry");
  const auto is_panel = [&](const std::string& name) { return pictures.count("panel-" + name) != 0; };
  for (const auto& [input, picture] : pictures) {
    const InputRole* role = role_of(technique, input);
    if (role && role->name == "mask" && !is_panel(std::string(name_in(*role, input))))
      return fail(StatusCode::kInvalidInput, input, "is the mask of no panel, expected one of that name");
  }
  for (const auto& options : parquetry::read_panel_options(std::get<Params>(job.params).panels))
    if (!is_panel(options.name))
      return fail(StatusCode::kInvalidParameter, "panels",
                  fmt::format("tells of {}, but there is no panel of that name", options.name));
  if (std::get<Params>(job.params).posterize > 0 && pictures.count("segmentation") != 0)
    return fail(StatusCode::kInvalidParameter, "posterize", "is set beside a segmentation, expected one of the two");
  if (pictures.count("edge-mask") != 0 && std::get<Params>(job.params).grid != parquetry::GridKind::kMorphed)
    return fail(StatusCode::kInvalidInput, "edge-mask",
                "is given where the grid is regular, expected none, or grid "
                "morphed");
  return {};
}

Rgb mean_colour(const Panel& panel, const CutPiece& piece) {
  std::int64_t sum[3] = {0, 0, 0}, count = 0;
  each_run(piece.on_panel, panel.scan.cols, panel.scan.rows, [&](int y, int begin, int end) {
    for (int x = begin; x < end; ++x)
      for (int c = 0; c < 3; ++c) sum[c] += panel.scan(y, x)[c];
    count += end - begin;
  });
  const auto mean = [&](int c) { return static_cast<std::uint8_t>(count > 0 ? (sum[c] + count / 2) / count : 0); };
  return {mean(0), mean(1), mean(2)};
}

PieceSheet sheet_of(const Parquetry& made) {
  const std::vector<int> lefts = parquetry::side_by_side(made.targets);
  PieceSheet sheet;
  sheet.width = lefts.back();
  for (const cv::Size& target : made.targets) sheet.height = std::max<double>(sheet.height, target.height);
  sheet.width_mm = sheet.width * made.mm_per_px();
  for (const CutPiece& piece : made.pieces) {
    Polygon outline = piece.finished;
    const Point by{static_cast<double>(lefts[static_cast<std::size_t>(piece.target - 1)]), 0};
    for (Point& p : outline.outer) p = p + by;
    for (Ring& hole : outline.holes)
      for (Point& p : hole) p = p + by;
    sheet.pieces.push_back({static_cast<int>(sheet.pieces.size()) + 1, std::move(outline),
                            mean_colour(made.panels[piece.panel], piece)});
  }
  return sheet;
}

// Draws wood in place of its mean colours.
void draw_wood(const Parquetry& made, Raster& picture) {
  cv::Mat3b drawn(picture.height, picture.width, reinterpret_cast<cv::Vec3b*>(picture.bytes.data()));
  const std::vector<int> lefts = parquetry::side_by_side(made.targets);
  const double scale = static_cast<double>(picture.width) / lefts.back();
  for (std::size_t i = 0; i < made.targets.size(); ++i) {
    Raster wood = parquetry::finished_preview(made.panels, made.pieces, static_cast<int>(i) + 1, made.targets[i]);
    cv::Mat3b scaled(wood.height, wood.width, reinterpret_cast<cv::Vec3b*>(wood.bytes.data()));
    if (scale != 1) cv::resize(scaled, scaled, {}, scale, scale, cv::INTER_LINEAR);
    const cv::Rect place(static_cast<int>(std::lround(scale * lefts[i])), 0, scaled.cols, scaled.rows);
    const cv::Rect within = place & cv::Rect({0, 0}, drawn.size());
    scaled(within - place.tl()).copyTo(drawn(within));
  }
}

// In the parameters' units: seconds at the speed of cutting, ways between the cuts not counted.
double cut_minutes(double cut_mm, const Params& params) { return cut_mm / params.cut_speed / 60; }

void add_wood(const Parquetry& made, Outcome& outcome) {
  double used = 0, free = 0, cut = 0, travel = 0;
  for (std::size_t i = 0; i < made.panels.size(); ++i) {
    const Panel& panel = made.panels[i];
    const parquetry::CutSheet sheet = parquetry::cut_sheet(made.panels, i, made.pieces, made.params);
    double used_here = 0;
    for (const CutPiece& piece : made.pieces)
      if (piece.panel == i) used_here += piece.area_mm2;
    const double free_here = cv::countNonZero(panel.mask) * panel.mm_per_px * panel.mm_per_px;
    outcome.metrics["wood_used_" + panel.name] = used_here / free_here;
    if (panel.registered) {
      double squares = 0;
      for (const double residual : panel.residuals) squares += residual * residual;
      outcome.metrics["marks_rms_mm_" + panel.name] =
          std::sqrt(squares / static_cast<double>(panel.residuals.size()));
      outcome.metrics["marks_worst_mm_" + panel.name] =
          *std::max_element(panel.residuals.begin(), panel.residuals.end());
    }
    used += used_here, free += free_here, cut += sheet.cut_mm, travel += sheet.travel_mm;
  }
  outcome.metrics["wood_used"] = used / free;
  outcome.metrics["wood_mm2"] = used;
  outcome.metrics["cut_mm"] = cut;
  outcome.metrics["travel_mm"] = travel;
  outcome.metrics["cut_minutes"] = cut_minutes(cut, made.params);
}

// What all finished pieces may be at most: larger ones are slips.
constexpr double kMostPixels = 2e8, kMostPatches = 200000;

Result<void> check_size(const std::vector<ImageView>& targets, const Params& params, double mm_per_px) {
  double area_mm2 = 0;
  for (const ImageView& target : targets) {
    const double shorter = std::min(target.width, target.height), longer = std::max(target.width, target.height);
    area_mm2 += params.image_size_mm * params.image_size_mm * longer / shorter;
  }
  const double patches = area_mm2 / (params.patch_mm * params.patch_mm), pixels = area_mm2 / (mm_per_px * mm_per_px);
  if (patches > kMostPatches || pixels > kMostPixels)
    return fail(StatusCode::kInvalidParameter, "imageSizeMm",
                fmt::format("makes {:.2f} m2 of {:.0f} patches and {:.0f} Mpx, expected at most {} and {} Mpx",
                            area_mm2 / 1e6, patches, pixels / 1e6, kMostPatches, kMostPixels / 1e6));
  return {};
}

std::vector<cv::Size> sizes_of(const std::vector<cv::Mat3b>& targets) {
  std::vector<cv::Size> sizes;
  for (const cv::Mat3b& target : targets) sizes.push_back(target.size());
  return sizes;
}

// What is to be laid on each target.
Result<parquetry::Request> request_of(const std::vector<ImageView>& targets, const parquetry::Drawn& drawn,
                                      const Params& params, double mm_per_px) {
  parquetry::Request request;
  request.interleaved = params.sequence == parquetry::Sequence::kInterleaved;
  for (const ImageView& picture : targets) {
    const int index = static_cast<int>(request.targets.size());
    request.targets.push_back(parquetry::at_resolution(picture.mat(), params, mm_per_px));
    const auto patches = parquetry::patches_of(request.targets.back(), drawn, params, mm_per_px, index);
    if (!patches) return tl::unexpected<Status>(patches.error());
    request.patches.insert(request.patches.end(), patches->begin(), patches->end());
  }
  return request;
}

void warn_of_narrow_patches(const parquetry::Request& request, const Params& params, double mm_per_px,
                            const RunContext& context) {
  if (params.seams == parquetry::SeamKind::kNone) return;
  for (const cv::Mat3b& target : request.targets) {
    if (parquetry::stray_of(parquetry::grid_of(target.size(), params, mm_per_px), params, mm_per_px) > 0) continue;
    context.warn("seams stay straight: patches have no room for others, in pixels of the panels, beside minWidthMm");
    return;
  }
}

// Tells requests apart: everything that decides how patches are laid, but not what comes after.
std::uint64_t fingerprint_of(Job job, const parquetry::Request& request, const std::vector<Panel>& panels) {
  auto& params = std::get<Params>(job.params);
  const Params usual;
  params.improve_tries = usual.improve_tries;
  params.cut_speed = usual.cut_speed;
  params.overlap_mm = usual.overlap_mm;
  params.side = usual.side;
  params.registration = usual.registration;
  params.panels = fmt::format("{}", panels.front().mm_per_px);  // what else it says is in scans and masks
  job.inputs.clear();                                           // what is in them counts
  std::uint64_t fingerprint = parquetry::fingerprint_of(job_to_text(job));
  for (const cv::Mat3b& target : request.targets) fingerprint = parquetry::fingerprint_of(target, fingerprint);
  for (const parquetry::Patch& patch : request.patches) {
    fingerprint = parquetry::fingerprint_of(fmt::format("{} {}", patch.box.x, patch.box.y), fingerprint);
    fingerprint = parquetry::fingerprint_of(patch.mask, fingerprint);
  }
  for (const Panel& panel : panels) {
    fingerprint = parquetry::fingerprint_of(panel.name, fingerprint);
    fingerprint = parquetry::fingerprint_of(panel.scan, fingerprint);
    fingerprint = parquetry::fingerprint_of(panel.mask, fingerprint);
  }
  return fingerprint;
}

struct Matched {
  parquetry::Output output;
  std::string state;
  int tries = 0;  // to improve it
};

// The matching (3.2, 3.3), which may be stopped and go on.
Result<Matched> match(const Job& job, const std::vector<Panel>& panels, parquetry::Request request,
                      const RunContext& context) {
  const auto& params = std::get<Params>(job.params);
  const std::uint64_t fingerprint = fingerprint_of(job, request, panels);
  if (!context.earlier.empty()) {
    auto earlier =
        parquetry::read_state(context.earlier, fingerprint, request.patches, params, panels.front().mm_per_px);
    if (earlier && !parquetry::are_possible(*earlier, panels, params)) earlier.reset();
    if (!earlier && !context.earlier_if_fits)
      return fail(StatusCode::kInvalidInput, "", "is of another job or damaged, expected one that this job has left");
    if (earlier) request.earlier = *std::move(earlier);
  }
  Matched matched;
  if (context.go_on_improving || params.improve_tries > 0)
    request.improve = [&] {
      const bool go_on = context.go_on_improving ? context.go_on_improving() : matched.tries < params.improve_tries;
      matched.tries += go_on;
      return go_on;
    };
  std::vector<parquetry::Laid> laid = request.earlier;
  const auto offer = [&] {
    if (context.on_state) context.on_state([&] { return parquetry::write_state(fingerprint, laid); });
  };
  auto output = parquetry::run(panels, request, params, context, [&](const std::vector<parquetry::Laid>& pieces) {
    laid.insert(laid.end(), pieces.begin(), pieces.end());
    offer();
  });
  if (!output) {
    offer();
    return tl::unexpected<Status>(std::move(output.error()));
  }
  matched.output = *std::move(output);
  matched.state = parquetry::write_state(fingerprint, laid);
  return matched;
}

// Says which patches found no wood, and what wood they would have liked.
void tell_missing(const parquetry::Output& output, const std::vector<cv::Mat3b>& targets, const Params& params,
                  double mm_per_px, const RunContext& context) {
  constexpr std::size_t kNamed = 12;
  const std::vector<std::string> names = parquetry::names_of(output.patches);
  std::string named;
  std::size_t missing = 0;
  double area = 0;
  std::int64_t light = 0, pixels = 0;
  for (const Placement& placement : output.placements) {
    if (placement.panel >= 0) continue;
    const auto patch = static_cast<std::size_t>(placement.patch);
    if (++missing <= kNamed) named += (missing > 1 ? ", " : "") + names[patch];
    const cv::Rect box = output.patches[patch].box;
    const cv::Mat3b& target = targets[static_cast<std::size_t>(output.patches[patch].target)];
    area += parquetry::taken_mm2(output.patches[patch], params, mm_per_px);
    for (const std::uint8_t level : cv::Mat1b(parquetry::intensity_of(target(box)))) light += level;
    pixels += box.area();
  }
  if (missing == 0) return;
  if (missing > kNamed) named += fmt::format(" and {} more", missing - kNamed);
  context.warn(fmt::format("no wood is left for {} of {} patches: {}; some {:.0f} cm2 more of {} wood would help",
                           missing, output.patches.size(), named, std::ceil(area / 100),
                           parquetry::tone_name(static_cast<int>(light / pixels))));
}

// Costs and gaps, of all targets together and of each of several. A pixel's cost is that of pixels with wood.
void add_targets(const parquetry::Output& output, std::size_t targets, Outcome& outcome) {
  struct Sum {
    std::int64_t pieces = 0, missing = 0, cost = 0, pixels = 0;
    double cost_per_px() const { return pixels > 0 ? static_cast<double>(cost) / static_cast<double>(pixels) : 0; }
  };
  Sum all;
  std::vector<Sum> each(targets);
  for (const Placement& placement : output.placements) {
    const parquetry::Patch& patch = output.patches[static_cast<std::size_t>(placement.patch)];
    for (Sum* sum : {&all, &each[static_cast<std::size_t>(patch.target)]}) {
      const bool is_missing = placement.panel < 0;
      ++(is_missing ? sum->missing : sum->pieces);
      sum->cost += placement.cost;
      sum->pixels += is_missing ? 0 : cv::countNonZero(patch.mask);
    }
  }
  outcome.metrics["cost_per_px"] = all.cost_per_px();
  if (targets < 2) return;
  outcome.counts["targets"] = static_cast<std::int64_t>(targets);
  for (std::size_t i = 0; i < targets; ++i) {
    const std::string of = fmt::format("_target_{}", i + 1);
    outcome.counts["pieces" + of] = each[i].pieces;
    outcome.counts["missing" + of] = each[i].missing;
    outcome.metrics["cost" + of] = static_cast<double>(each[i].cost);
    if (each[i].pieces > 0) outcome.metrics["cost_per_px" + of] = each[i].cost_per_px();
  }
}

}  // namespace

Result<Outcome> run_parquet_job(const Job& job, const Pictures& pictures, Rasterizer& /*rasterizer*/,
                                const RunContext& context, const IterationObserver& /*observer*/) {
  const auto& params = std::get<Params>(job.params);
  if (auto named = check_inputs(job, pictures); !named) return tl::unexpected<Status>(std::move(named.error()));
  context.stage("panels");
  auto panels = parquetry::take_in(scans_of(pictures), params, context);
  if (!panels) return tl::unexpected<Status>(std::move(panels.error()));
  const double mm_per_px = panels->front().mm_per_px;
  const std::vector<ImageView> targets = targets_of(pictures, params);
  if (auto good = check_size(targets, params, mm_per_px); !good)
    return tl::unexpected<Status>(std::move(good.error()));
  context.stage("patches");
  const auto request = request_of(targets, drawn_in(pictures), params, mm_per_px);
  if (!request) return tl::unexpected<Status>(request.error());
  warn_of_narrow_patches(*request, params, mm_per_px, context);
  auto matched = match(job, *panels, *request, context);
  if (!matched) return tl::unexpected<Status>(std::move(matched.error()));
  const parquetry::Output& output = matched->output;
  tell_missing(output, request->targets, params, mm_per_px, context);

  Outcome outcome;
  outcome.done = job;
  outcome.state = std::move(matched->state);
  std::get<Params>(outcome.done->params).improve_tries = matched->tries;
  auto made = std::make_shared<Parquetry>();
  made->pieces = parquetry::pieces_of(*panels, output.patches, output.placements, params);
  made->missing = parquetry::missing_of(output.patches, output.placements);
  made->params = params;
  made->panels = *std::move(panels);
  for (const cv::Mat3b& target : request->targets) made->targets.push_back(target.size());
  made->job_json = job_to_text(*outcome.done);
  outcome.sheet = sheet_of(*made);
  outcome.counts = {{"patches", static_cast<std::int64_t>(output.patches.size())},
                    {"pieces", static_cast<std::int64_t>(made->pieces.size())},
                    {"missing", output.without_wood},
                    {"quartered", output.quartered},
                    {"rounds", output.rounds},
                    {"exchanges", output.exchanges},
                    {"panels", static_cast<std::int64_t>(made->panels.size())}};
  outcome.metrics = {{"cost", static_cast<double>(output.cost)},
                     {"greedy_cost", static_cast<double>(output.greedy_cost)},
                     {"reconstruction_cost", static_cast<double>(output.reconstruction_cost)},
                     {"straight_cost", static_cast<double>(output.straight_cost)},
                     {"seams_moved", output.seams_moved}};
  add_targets(output, made->targets.size(), outcome);
  add_wood(*made, outcome);
  outcome.folder = [made] { return parquet_folder(*made); };
  outcome.finish = [made](Raster& picture) { draw_wood(*made, picture); };
  return outcome;
}

namespace {

// Of a mask, row by row from the top left: how many pixels are no wood, how many after these are, and so on in turn.
std::vector<int> runs_of(const cv::Mat1b& mask) {
  std::vector<int> runs = {0};
  bool wood = false;
  for (const std::uint8_t value : mask) {
    if ((value != 0) != wood) runs.push_back(0);
    wood = value != 0;
    ++runs.back();
  }
  return runs;
}

// A line of JSON a panel: its mask as runs_of() and the marks' middles, px of the scan, and diameter.
Result<std::string> describe_panels(const Job& job, const Pictures& pictures, const RunContext& context) {
  if (scans_of(pictures).empty()) return fail(StatusCode::kInvalidInput, "panel", "is missing, expected a picture");
  const auto panels = parquetry::look_at(scans_of(pictures), std::get<Params>(job.params), context);
  if (!panels) return tl::unexpected<Status>(panels.error());
  std::string text;
  for (const Panel& panel : *panels) {
    Json marks = Json::array();
    for (const Point mark : panel.fiducials) marks.push_back({panel.scan_px * mark.x, panel.scan_px * mark.y});
    text += Json({{"panel", panel.name},
                  {"width", panel.mask.cols},
                  {"height", panel.mask.rows},
                  {"wood", runs_of(panel.mask)},
                  {"marks", marks},
                  {"mark_px", panel.scan_px * panel.fiducial_mm / panel.mm_per_px}})
                .dump() +
            "\n";
  }
  return text;
}

}  // namespace

Result<void> begin_live_grid(const Job& job, const Pictures& pictures, std::unique_ptr<parquetry::LiveGrid>& grid) {
  const auto& params = std::get<Params>(job.params);
  if (params.grid != parquetry::GridKind::kMorphed)
    return fail(StatusCode::kInvalidParameter, "grid", "is regular, expected morphed");
  const double mm_per_px = parquetry::mm_per_px_of(scans_of(pictures), params);
  const std::vector<ImageView> targets = targets_of(pictures, params);
  if (targets.empty()) return fail(StatusCode::kInvalidInput, "target", "is missing, expected a picture");
  if (auto good = check_size({targets.front()}, params, mm_per_px); !good) return good;
  const cv::Mat3b target = parquetry::at_resolution(targets.front().mat(), params, mm_per_px);
  const auto masks = parquetry::edge_masks_of(picture_of(pictures, "edge-mask"), target.size());
  if (!masks) return tl::unexpected<Status>(masks.error());
  if (!grid || !grid->is_of(target, params, mm_per_px))
    grid = std::make_unique<parquetry::LiveGrid>(target, params, mm_per_px);
  return grid->begin(params, *masks);
}

std::vector<Question> parquet_questions() {
  const auto plan = [](const Job& job, const Pictures& pictures, const RunContext&) -> Result<std::string> {
    const auto& params = std::get<Params>(job.params);
    const std::vector<ImageView> targets = targets_of(pictures, params);
    if (auto good = check_size(targets, params, parquetry::plan_mm_per_px(params)); !good)
      return tl::unexpected<Status>(std::move(good.error()));
    const double mm_per_px = parquetry::plan_mm_per_px(params);
    const auto request = request_of(targets, drawn_in(pictures), params, mm_per_px);
    if (!request) return tl::unexpected<Status>(request.error());
    return describe(parquetry::plan_of(sizes_of(request->targets), request->patches, params, mm_per_px), params);
  };
  const auto forecast = [](const Job& job, const Pictures& pictures,
                           const RunContext& context) -> Result<std::string> {
    const auto& params = std::get<Params>(job.params);
    if (scans_of(pictures).empty()) return fail(StatusCode::kInvalidInput, "panel", "is missing, expected a picture");
    if (auto named = check_inputs(job, pictures); !named) return tl::unexpected<Status>(std::move(named.error()));
    const auto panels = parquetry::take_in(scans_of(pictures), params, context);
    if (!panels) return tl::unexpected<Status>(panels.error());
    const std::vector<ImageView> targets = targets_of(pictures, params);
    if (auto good = check_size(targets, params, panels->front().mm_per_px); !good)
      return tl::unexpected<Status>(std::move(good.error()));
    const auto request = request_of(targets, drawn_in(pictures), params, panels->front().mm_per_px);
    if (!request) return tl::unexpected<Status>(request.error());
    return describe(parquetry::forecast_of(request->targets, request->patches, *panels, params), *panels, params);
  };
  return {{"plan",
           "Tell how many pieces, how much wood and cutting it takes; needs no panel",
           {"target", "segmentation", "edge-mask"},
           plan},
          {"masks",
           "Tell where wood and marks are found on the panels, a line of JSON each",
           {"panel", "mask"},
           describe_panels},
          {"forecast",
           "Tell whether the panels suffice, and make nothing",
           {"target", "segmentation", "edge-mask", "panel", "mask"},
           forecast}};
}

}  // namespace tessera

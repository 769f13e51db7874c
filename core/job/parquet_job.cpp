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
#include "tessera/parquetry/morphed_patches.h"
#include "tessera/parquetry/panels.h"
#include "tessera/parquetry/patches.h"
#include "tessera/parquetry/plan.h"
#include "tessera/parquetry/run.h"
#include "tessera/parquetry/state.h"

namespace tessera {
namespace {

using parquetry::CutPiece;
using parquetry::Panel;
using parquetry::Params;
using parquetry::Placement;

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

// Masks and options of panels that are not there.
Result<void> check_names(const Job& job, const Pictures& pictures) {
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
  return {};
}

Rgb mean_colour(const Panel& panel, const CutPiece& piece) {
  std::int64_t sum[3] = {0, 0, 0}, count = 0;
  each_run(piece.on_panel.outer, panel.scan.cols, panel.scan.rows, [&](int y, int begin, int end) {
    for (int x = begin; x < end; ++x)
      for (int c = 0; c < 3; ++c) sum[c] += panel.scan(y, x)[c];
    count += end - begin;
  });
  const auto mean = [&](int c) { return static_cast<std::uint8_t>(count > 0 ? (sum[c] + count / 2) / count : 0); };
  return {mean(0), mean(1), mean(2)};
}

PieceSheet sheet_of(const Parquetry& made) {
  PieceSheet sheet;
  sheet.width = made.size.width;
  sheet.height = made.size.height;
  sheet.width_mm = made.size.width * made.mm_per_px();
  for (const CutPiece& piece : made.pieces)
    if (piece.target == 1)
      sheet.pieces.push_back(
          {static_cast<int>(sheet.pieces.size()) + 1, piece.finished, mean_colour(made.panels[piece.panel], piece)});
  return sheet;
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

// What a finished piece may be at most: larger ones are slips.
constexpr double kMostPixels = 2e8, kMostPatches = 200000;

Result<void> check_size(const ImageView& target, const Params& params, double mm_per_px) {
  const double shorter = std::min(target.width, target.height), longer = std::max(target.width, target.height);
  const double area_mm2 = params.image_size_mm * params.image_size_mm * longer / shorter;
  const double patches = area_mm2 / (params.patch_mm * params.patch_mm), pixels = area_mm2 / (mm_per_px * mm_per_px);
  if (patches > kMostPatches || pixels > kMostPixels)
    return fail(
        StatusCode::kInvalidParameter, "imageSizeMm",
        fmt::format(
            "makes a piece of {:.0f} x {:.0f} mm of {:.0f} patches and {:.0f} Mpx, expected at most {} and {} Mpx",
            params.image_size_mm, params.image_size_mm * longer / shorter, patches, pixels / 1e6, kMostPatches,
            kMostPixels / 1e6));
  return {};
}

// Tells requests apart: everything that decides how patches are laid, but not what comes after.
std::uint64_t fingerprint_of(Job job, const parquetry::Request& request, const std::vector<Panel>& panels) {
  std::get<Params>(job.params).improve_tries = 0;
  job.inputs.clear();  // what is in them counts
  std::uint64_t fingerprint = parquetry::fingerprint_of(job_to_text(job));
  for (const cv::Mat3b& target : request.targets) fingerprint = parquetry::fingerprint_of(target, fingerprint);
  for (const Panel& panel : panels) {
    fingerprint = parquetry::fingerprint_of(panel.name, fingerprint);
    fingerprint = parquetry::fingerprint_of(panel.scan, fingerprint);
    fingerprint = parquetry::fingerprint_of(panel.mask, fingerprint);
  }
  return fingerprint;
}

// 3.4, what of it comes before the matching.
Result<std::vector<parquetry::Patch>> patches_of(const cv::Mat3b& target, const Params& params, double mm_per_px,
                                                 const RunContext& context) {
  if (params.grid == parquetry::GridKind::kRegular) return grid_patches(target.size(), params, mm_per_px);
  context.stage("morphing");
  return morphed_patches(target, params, mm_per_px);
}

// The matching (3.2, 3.3), which may be stopped and go on. `tries` counts what was tried to improve it.
Result<parquetry::Output> match(const Job& job, const std::vector<Panel>& panels, parquetry::Request request,
                                const RunContext& context, int& tries) {
  const auto& params = std::get<Params>(job.params);
  const std::uint64_t fingerprint = fingerprint_of(job, request, panels);
  if (!context.earlier.empty()) {
    auto earlier =
        parquetry::read_state(context.earlier, fingerprint, request.patches, params, panels.front().mm_per_px);
    if (!earlier)
      return fail(StatusCode::kInvalidInput, "", "is of another job, expected one that this job has left");
    request.earlier = *std::move(earlier);
  }
  if (context.go_on_improving || params.improve_tries > 0)
    request.improve = [&] {
      const bool go_on = context.go_on_improving ? context.go_on_improving() : tries < params.improve_tries;
      tries += go_on;
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
  if (!output) offer();
  return output;
}

// Says which patches found no wood, and what wood they would have liked.
void tell_missing(const parquetry::Output& output, const cv::Mat3b& target, const Params& params, double mm_per_px,
                  const RunContext& context) {
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
    const double around = params.kerf_mm + params.clearance_mm;
    area += (box.width * mm_per_px + around) * (box.height * mm_per_px + around);
    for (const std::uint8_t level : cv::Mat1b(parquetry::intensity_of(target(box)))) light += level;
    pixels += box.area();
  }
  if (missing == 0) return;
  if (missing > kNamed) named += fmt::format(" and {} more", missing - kNamed);
  context.warn(fmt::format("no wood is left for {} of {} patches: {}; some {:.0f} cm2 more of {} wood would help",
                           missing, output.patches.size(), named, std::ceil(area / 100),
                           parquetry::tone_name(static_cast<int>(light / pixels))));
}

}  // namespace

Result<Outcome> run_parquet_job(const Job& job, const Pictures& pictures, Rasterizer& /*rasterizer*/,
                                const RunContext& context, const IterationObserver& /*observer*/) {
  const auto& params = std::get<Params>(job.params);
  if (auto named = check_names(job, pictures); !named) return tl::unexpected<Status>(std::move(named.error()));
  context.stage("panels");
  auto panels = parquetry::take_in(scans_of(pictures), params, context);
  if (!panels) return tl::unexpected<Status>(std::move(panels.error()));
  const double mm_per_px = panels->front().mm_per_px;
  const ImageView& picture = pictures.at("target");
  if (auto good = check_size(picture, params, mm_per_px); !good)
    return tl::unexpected<Status>(std::move(good.error()));
  parquetry::Request request;
  request.targets = {parquetry::at_resolution(picture.mat(), params, mm_per_px)};
  auto patches = patches_of(request.targets.front(), params, mm_per_px, context);
  if (!patches) return tl::unexpected<Status>(std::move(patches.error()));
  request.patches = *std::move(patches);
  int tries = 0;
  auto output = match(job, *panels, request, context, tries);
  if (!output) return tl::unexpected<Status>(std::move(output.error()));
  tell_missing(*output, request.targets.front(), params, mm_per_px, context);

  Outcome outcome;
  outcome.done = job;
  std::get<Params>(outcome.done->params).improve_tries = tries;
  auto made = std::make_shared<Parquetry>();
  made->pieces = parquetry::pieces_of(*panels, output->patches, output->placements);
  made->params = params;
  made->panels = *std::move(panels);
  made->size = request.targets.front().size();
  made->job_json = job_to_text(*outcome.done);
  outcome.sheet = sheet_of(*made);
  outcome.counts = {{"patches", static_cast<std::int64_t>(output->patches.size())},
                    {"pieces", static_cast<std::int64_t>(made->pieces.size())},
                    {"missing", output->without_wood},
                    {"quartered", output->quartered},
                    {"rounds", output->rounds},
                    {"exchanges", output->exchanges},
                    {"panels", static_cast<std::int64_t>(made->panels.size())}};
  outcome.metrics = {{"cost", static_cast<double>(output->cost)},
                     {"greedy_cost", static_cast<double>(output->greedy_cost)},
                     {"reconstruction_cost", static_cast<double>(output->reconstruction_cost)},
                     {"straight_cost", static_cast<double>(output->straight_cost)},
                     {"seams_moved", output->seams_moved},
                     {"cost_per_px", static_cast<double>(output->cost) / static_cast<double>(made->size.area())}};
  add_wood(*made, outcome);
  outcome.folder = [made] { return parquet_folder(*made); };
  return outcome;
}

std::vector<Question> parquet_questions() {
  const auto plan = [](const Job& job, const Pictures& pictures, const RunContext&) -> Result<std::string> {
    const auto& params = std::get<Params>(job.params);
    const ImageView target = picture_of(pictures, "target");
    if (auto good = check_size(target, params, parquetry::plan_mm_per_px(params)); !good)
      return tl::unexpected<Status>(std::move(good.error()));
    return describe(parquetry::plan_of({target.width, target.height}, params), params);
  };
  const auto forecast = [](const Job& job, const Pictures& pictures,
                           const RunContext& context) -> Result<std::string> {
    const auto& params = std::get<Params>(job.params);
    if (scans_of(pictures).empty()) return fail(StatusCode::kInvalidInput, "panel", "is missing, expected a picture");
    if (auto named = check_names(job, pictures); !named) return tl::unexpected<Status>(std::move(named.error()));
    const auto panels = parquetry::take_in(scans_of(pictures), params, context);
    if (!panels) return tl::unexpected<Status>(panels.error());
    if (auto good = check_size(pictures.at("target"), params, panels->front().mm_per_px); !good)
      return tl::unexpected<Status>(std::move(good.error()));
    return describe(parquetry::forecast_of(pictures.at("target").mat(), *panels, params), *panels, params);
  };
  return {{"plan", "Tell how many pieces, how much wood and cutting it takes; needs no panel", {"target"}, plan},
          {"forecast", "Tell whether the panels suffice, and make nothing", {"target", "panel", "mask"}, forecast}};
}

}  // namespace tessera

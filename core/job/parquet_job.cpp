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
#include "tessera/parquetry/panels.h"

namespace tessera {
namespace {

using parquetry::CutPiece;
using parquetry::Panel;
using parquetry::Params;
using parquetry::Patch;
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
      sheet.pieces.push_back({static_cast<int>(sheet.pieces.size()) + 1, piece.finished,
                              mean_colour(made.panels[piece.panel], piece)});
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

// ---- stand-in for the matching
struct Laid {
  std::vector<Patch> patches;
  std::vector<Placement> placements;
  cv::Size size;
};

Laid lay_trivially(const ImageView& target, const std::vector<Panel>& panels, const Params& p) {
  Laid laid;
  const double mm = panels[0].mm_per_px, s = p.patch_mm / mm;
  const int n = std::max(1, static_cast<int>(p.image_size_mm / p.patch_mm));
  const int rows = target.width >= target.height ? n : n * target.height / target.width;
  const int columns = target.width >= target.height ? n * target.width / target.height : n;
  laid.size = {static_cast<int>(columns * s), static_cast<int>(rows * s)};
  std::vector<cv::Mat1b> free;
  for (const Panel& panel : panels) free.push_back(panel.mask.clone());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      Patch patch;
      patch.row = r, patch.column = c;
      const double x0 = c * laid.size.width / double(columns), x1 = (c + 1) * laid.size.width / double(columns);
      const double y0 = r * laid.size.height / double(rows), y1 = (r + 1) * laid.size.height / double(rows);
      patch.outline.outer = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
      Placement placement;
      placement.patch = static_cast<int>(laid.patches.size());
      placement.from = {(x0 + x1) / 2, (y0 + y1) / 2};
      placement.turn_deg = 24 * ((r * 7 + c) % 15);
      for (std::size_t i = 0; i < panels.size() && placement.panel < 0; ++i) {
        const int half = static_cast<int>(s * 0.72 + p.clearance_mm / mm + 2);
        for (int y = half; y + half < free[i].rows && placement.panel < 0; y += half / 2)
          for (int x = half; x + half < free[i].cols; x += half / 2) {
            cv::Mat1b window = free[i](cv::Rect(x - half, y - half, 2 * half, 2 * half));
            if (cv::countNonZero(window) < 4 * half * half) continue;
            window.setTo(0);
            placement.panel = static_cast<int>(i);
            placement.to = {x + 0.3, y + 0.4};
            break;
          }
      }
      laid.patches.push_back(patch);
      laid.placements.push_back(placement);
    }
  return laid;
}

}  // namespace

Result<Outcome> run_parquet_job(const Job& job, const Pictures& pictures, Rasterizer& /*rasterizer*/,
                                const RunContext& context, const IterationObserver& /*observer*/) {
  const auto& params = std::get<Params>(job.params);
  if (auto named = check_names(job, pictures); !named) return tl::unexpected<Status>(std::move(named.error()));
  context.stage("panels");
  auto panels = parquetry::take_in(scans_of(pictures), params, context);
  if (!panels) return tl::unexpected<Status>(std::move(panels.error()));
  Laid laid = lay_trivially(pictures.at("target"), *panels, params);

  auto made = std::make_shared<Parquetry>();
  made->pieces = parquetry::pieces_of(*panels, laid.patches, laid.placements);
  made->params = params;
  made->panels = *std::move(panels);
  made->size = laid.size;
  made->job_json = job_to_text(job);
  Outcome outcome;
  outcome.sheet = sheet_of(*made);
  outcome.counts = {{"patches", static_cast<std::int64_t>(laid.patches.size())},
                    {"pieces", static_cast<std::int64_t>(made->pieces.size())},
                    {"missing", static_cast<std::int64_t>(laid.patches.size() - made->pieces.size())},
                    {"panels", static_cast<std::int64_t>(made->panels.size())}};
  add_wood(*made, outcome);
  outcome.folder = [made] { return parquet_folder(*made); };
  return outcome;
}

std::vector<Question> parquet_questions() { return {}; }

}  // namespace tessera

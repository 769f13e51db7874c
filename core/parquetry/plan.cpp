#include "tessera/parquetry/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "tessera/parquetry/features.h"
#include "tessera/parquetry/patches.h"

namespace tessera::parquetry {
namespace {

constexpr double kPlanMmPerPx = 25.4 / 150;
constexpr int kTones = 4;
constexpr const char* kToneNames[kTones] = {"dark", "rather dark", "rather light", "light"};
constexpr double kPacked = 0.8;  // of the free wood, what turned pieces can be got from

int tone_of(int level) { return level * kTones / 256; }

double length_around(const Patch& patch) {
  double length = perimeter(patch.outline.outer);
  for (const Ring& hole : patch.outline.holes) length += perimeter(hole);
  return length;
}

// Means over the area of a patch.
cv::Mat1b averaged(const cv::Mat1b& levels, const Params& params, double mm_per_px) {
  const int side = std::max(1, static_cast<int>(params.patch_mm / mm_per_px));
  cv::Mat1b means;
  cv::boxFilter(levels, means, CV_8U, {side, side}, {-1, -1}, true, cv::BORDER_REPLICATE);
  return means;
}

std::int64_t mean_level(const cv::Mat1b& levels, const cv::Mat1b& mask, const Tones& tones) {
  std::int64_t sum = 0, count = 0;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask(y, x) != 0) sum += tones[levels(y, x)], ++count;
  return sum / std::max<std::int64_t>(1, count);
}

// How many times the wood is needed, at most 1 where it suffices.
double shortage(double needed, double free) { return free > 0 ? needed / (kPacked * free) : needed > 0 ? 1e9 : 0; }

}  // namespace

double taken_mm2(const Patch& patch, const Params& params, double mm_per_px) {
  const double margin = params.kerf_mm + params.clearance_mm + 2 * mm_per_px * seam_play(params, mm_per_px);
  const Ring& outer = patch.outline.outer;
  return mm_per_px * mm_per_px * std::abs(signed_area(outer)) + mm_per_px * perimeter(outer) / 2 * margin +
         margin * margin;
}

double plan_mm_per_px(const Params& params) {
  return params.resolution_dpi > 0 ? 25.4 / params.resolution_dpi : kPlanMmPerPx;
}

const char* tone_name(int level) { return kToneNames[tone_of(level)]; }

Plan plan_of(const std::vector<cv::Size>& targets, const std::vector<Patch>& patches, const Params& params,
             double mm_per_px) {
  Plan plan;
  plan.targets = static_cast<int>(targets.size());
  plan.pieces = static_cast<int>(patches.size());
  plan.width_mm = targets.front().width * mm_per_px;
  plan.height_mm = targets.front().height * mm_per_px;
  for (const Patch& patch : patches) {
    plan.rows = std::max(plan.rows, patch.row + 1);
    plan.columns = std::max(plan.columns, patch.column + 1);
    plan.wood_mm2 += mm_per_px * mm_per_px * cv::countNonZero(patch.mask);
    plan.taken_mm2 += taken_mm2(patch, params, mm_per_px);
    plan.cut_mm += mm_per_px * length_around(patch) + 4 * params.kerf_mm;
  }
  plan.minutes = plan.cut_mm / params.cut_speed / 60;
  return plan;
}

double Forecast::free() const { return std::accumulate(free_mm2.begin(), free_mm2.end(), 0.0); }

Forecast forecast_of(const std::vector<cv::Mat3b>& targets, const std::vector<Patch>& patches,
                     const std::vector<Panel>& panels, const Params& params) {
  const double mm_per_px = panels.front().mm_per_px, mm2 = mm_per_px * mm_per_px;
  std::vector<cv::Size> sizes;
  for (const cv::Mat3b& target : targets) sizes.push_back(target.size());
  Forecast forecast;
  forecast.plan = plan_of(sizes, patches, params, mm_per_px);
  for (const char* name : kToneNames) forecast.tones.push_back({name});
  Histogram wood{};
  for (const Panel& panel : panels) {
    const cv::Mat1b levels = intensity_of(panel.scan), means = averaged(levels, params, mm_per_px);
    const Histogram own = histogram_of(levels, panel.mask);
    for (std::size_t level = 0; level < wood.size(); ++level) wood[level] += own[level];
    forecast.free_mm2.push_back(cv::countNonZero(panel.mask) * mm2);
    const Histogram coarse = histogram_of(means, panel.mask);
    for (int level = 0; level < 256; ++level)
      forecast.tones[static_cast<std::size_t>(tone_of(level))].free_mm2 +=
          static_cast<double>(coarse[static_cast<std::size_t>(level)]) * mm2;
  }
  std::vector<cv::Mat1b> levels;
  std::vector<Tones> tones;
  for (const cv::Mat3b& target : targets) {
    levels.push_back(intensity_of(target));
    tones.push_back(matched_tones(histogram_of(levels.back(), {}), wood, params.weight_histogram));
  }
  for (const Patch& patch : patches) {
    const cv::Mat1b own = levels[patch.target](patch.box);
    const int tone = tone_of(static_cast<int>(mean_level(own, patch.mask, tones[patch.target])));
    forecast.tones[static_cast<std::size_t>(tone)].needed_mm2 += taken_mm2(patch, params, mm_per_px);
  }
  return forecast;
}

std::string describe(const Plan& plan, const Params& params) {
  const bool is_grid = plan.pieces == plan.rows * plan.columns;
  const std::string rows = is_grid ? fmt::format(" in {} rows of {}", plan.rows, plan.columns) : std::string();
  const std::string what = plan.targets > 1 ? fmt::format("{} pieces of {} targets", plan.pieces, plan.targets)
                                            : fmt::format("{} pieces{}, {:.1f} x {:.1f} mm", plan.pieces, rows,
                                                          plan.width_mm, plan.height_mm);
  return fmt::format(
      "{}\n"
      "wood: {:.0f} cm2, with kerf and clearance {:.0f} cm2\n"
      "cutting: {:.2f} m, {:.1f} minutes at {:g} mm/s\n",
      what, plan.wood_mm2 / 100, plan.taken_mm2 / 100, plan.cut_mm / 1000, plan.minutes, params.cut_speed);
}

std::string describe(const Forecast& forecast, const std::vector<Panel>& panels, const Params& params) {
  std::string text = describe(forecast.plan, params);
  for (std::size_t i = 0; i < panels.size(); ++i)
    text += fmt::format("{}: {:.0f} cm2 of wood\n", panels[i].name, forecast.free_mm2[i] / 100);
  const ToneSupply* scarcest = nullptr;
  for (const ToneSupply& tone : forecast.tones) {
    text += fmt::format("{}: needs {:.0f} cm2, there are {:.0f} cm2\n", tone.name, tone.needed_mm2 / 100,
                        tone.free_mm2 / 100);
    if (!scarcest || shortage(tone.needed_mm2, tone.free_mm2) > shortage(scarcest->needed_mm2, scarcest->free_mm2))
      scarcest = &tone;
  }
  const double all = shortage(forecast.plan.taken_mm2, forecast.free());
  if (all > 1)
    text += fmt::format("The wood does not suffice: it takes some {:.0f} cm2 more\n",
                        (forecast.plan.taken_mm2 / kPacked - forecast.free()) / 100);
  else
    text += "The wood suffices\n";
  if (shortage(scarcest->needed_mm2, scarcest->free_mm2) > 1)
    text += fmt::format("Of {} wood some {:.0f} cm2 more would help\n", scarcest->name,
                        (scarcest->needed_mm2 / kPacked - scarcest->free_mm2) / 100);
  return text;
}

}  // namespace tessera::parquetry

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "tessera/formats/formats.h"
#include "tessera/geometry/extrude.h"
#include "tessera/job/guarded.h"
#include "tessera/job/job_json.h"
#include "tessera/job/recorder.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

// The technique's own share of the progress; the rest is writing the formats.
constexpr double kTechniqueShare = 0.95;

struct Format {
  const char* name;
  const char* media_type;
  std::string (*write)(const Outcome& outcome, double png_scale);
};

// A technique that makes no scene has its sheet's pieces as slabs.
std::string in_3d(const Outcome& made, std::string (*write)(const Scene&)) {
  return write(made.scene.views.empty() ? extruded(made.sheet) : made.scene);
}

// A small sheet is drawn larger, towards 2048 px, so that its pieces can be seen.
double png_scale_of(const PieceSheet& sheet, double asked) {
  if (asked > 0) return asked;
  return std::clamp(std::floor(2048 / std::max({sheet.width, sheet.height, 1.0})), 1.0, 4.0);
}

std::string picture_of(const Outcome& made, double scale) {
  return made.finish ? write_png(draw_picture(made, scale)) : write_png(made.sheet, scale);
}

const Format kFormats[] = {
    {"svg", "image/svg+xml", [](const Outcome& made, double) { return write_svg(made.sheet); }},
    {"dxf", "image/vnd.dxf", [](const Outcome& made, double) { return write_dxf(made.sheet); }},
    {"png", "image/png", picture_of},
    {"json", "application/geo+json", [](const Outcome& made, double) { return write_geojson(made.sheet); }},
    {"csv", "text/csv", [](const Outcome& made, double) { return write_csv(made.sheet); }},
    {"bom.csv", "text/csv", [](const Outcome& made, double) { return write_bill_csv(made.sheet); }},
    {"glb", "model/gltf-binary", [](const Outcome& made, double) { return in_3d(made, write_glb); }},
    {"gltf", "model/gltf+json", [](const Outcome& made, double) { return in_3d(made, write_gltf); }},
    {"labels.png", "image/png",
     [](const Outcome& made, double) { return write_png(made.rasters.at("labels.png")()); }},
    {"overlay.png", "image/png",
     [](const Outcome& made, double) { return write_png(made.rasters.at("overlay.png")()); }},
    {"apng", "image/apng",
     [](const Outcome& made, double scale) { return write_apng(made.sheet, made.frames, scale); }},
};

// `name` is among the technique's formats.
const Format& format_of(const std::string& name) {
  return *std::find_if(std::begin(kFormats), std::end(kFormats), [&](const Format& f) { return f.name == name; });
}

// Of a PNG: more is too much for other programs as well.
Result<void> check_png_size(const PieceSheet& sheet, double scale) {
  constexpr double kMostPixels = 1 << 30;
  const double width = sheet.width * scale, height = sheet.height * scale;
  if (width * height <= kMostPixels) return {};
  return fail(StatusCode::kInvalidParameter, "pngScale",
              fmt::format("makes a picture of {:.0f} x {:.0f} px, expected at most {:.0f} Mpx", width, height,
                          kMostPixels / 1e6));
}

void check_seed(const Job& job, Problems& problems) {
  if (job.seed <= kMaxSeed) return;
  problems.push_back(
      {StatusCode::kInvalidParameter, "seed", fmt::format("is {}, expected 0 to {}", job.seed, kMaxSeed)});
}

bool offers(const Technique& technique, std::string_view format) {
  return std::find(technique.formats.begin(), technique.formats.end(), format) != technique.formats.end();
}

void check_request(const Technique& technique, const JobRequest& request, Problems& problems) {
  for (const std::string& name : request.formats) {
    if (offers(technique, name)) continue;
    problems.push_back(
        {StatusCode::kInvalidParameter, name,
         fmt::format("is no output of {}, expected {}", technique.name, either_of(technique.formats))});
  }
  if (!(request.png_scale >= 0 && request.png_scale <= kMaxPngScale)) {
    problems.push_back({StatusCode::kInvalidParameter, "pngScale",
                        fmt::format("is {}, expected 0 to {}", request.png_scale, kMaxPngScale)});
  }
}

void check_pictures(const Technique& technique, const Pictures& pictures, Problems& problems) {
  for (const InputRole& role : technique.inputs) {
    bool missing = role.required;
    for (const auto& [input, picture] : pictures) {
      if (role_of(technique, input) != &role) continue;
      missing = false;
      if (!picture.pixels || picture.width < 1 || picture.height < 1)
        problems.push_back({StatusCode::kInvalidInput, input, "has no pixels, expected at least one"});
    }
    if (missing)
      problems.push_back({StatusCode::kInvalidInput, std::string(role.name), "is missing, expected a picture"});
  }
}

Result<std::vector<Artifact>> write_valid_artifacts(const Outcome& outcome, const JobRequest& request,
                                                    const RunContext& context) {
  context.stage("format");
  const double scale = png_scale_of(outcome.sheet, request.png_scale);
  std::vector<Artifact> artifacts;
  for (const std::string& name : request.formats) {
    if (auto go_on = context.check(); !go_on) return tl::unexpected<Status>(std::move(go_on.error()));
    if (name == "folder") {
      for (Artifact& file : outcome.folder()) {
        file.name = "folder/" + file.name;
        artifacts.push_back(std::move(file));
      }
      continue;
    }
    const Format& format = format_of(name);
    if (name == "png" || name == "apng")
      if (auto good = check_png_size(outcome.sheet, scale); !good) return tl::unexpected<Status>(good.error());
    artifacts.push_back({format.name, format.media_type, format.write(outcome, scale)});
    context.progress(static_cast<double>(artifacts.size()) / static_cast<double>(request.formats.size()));
  }
  if (request.plots) {
    for (const Plot& plot : outcome.plots)
      artifacts.push_back({fmt::format("plots/{}.svg", plot.name), "image/svg+xml", write_plot(plot)});
  }
  context.progress(1);
  return artifacts;
}

Result<Outcome> compute_valid_job(const Job& job, const Pictures& pictures, Rasterizer& rasterizer,
                                  const RunContext& context, const IterationObserver& observer, bool records) {
  const Technique& technique = technique_of(job.params);
  std::shared_ptr<Recorder> recorder;
  if (records && offers(technique, "apng"))
    recorder = std::make_shared<Recorder>(pictures.at(std::string(technique.inputs.front().name)));
  const IterationObserver record = [&](const Iteration& iteration) {
    recorder->record(iteration);
    if (observer) observer(iteration);
  };
  auto outcome = technique.run(job, pictures, rasterizer, context, recorder ? record : observer);
  if (!outcome) return outcome;
  if (!outcome->done) outcome->done = job;
  outcome->sheet.job_json = outcome->scene.job_json = job_to_text(*outcome->done);
  if (recorder) outcome->frames = {recorder->frames(), [recorder](int index) { return recorder->frame(index); }};
  return outcome;
}

// The context of a part of the run, which moves progress from `from` to `to`.
RunContext part_of(const RunContext& context, double from, double to) {
  RunContext part = context;
  part.on_progress = [&context, from, to](double fraction) { context.progress(from + (to - from) * fraction); };
  return part;
}

void check_job(const Job& job, Problems& problems) {
  check_params(job.params, problems);
  check_seed(job, problems);
}

}  // namespace

std::string write_plot(const Plot& plot) {
  if (const auto* curves = std::get_if<Curves>(&plot.figure)) return write_curves_svg(*curves);
  return write_histogram_svg(std::get<Histogram>(plot.figure));
}

tl::expected<Outcome, Problems> compute_job(const Job& job, const Pictures& pictures, Rasterizer& rasterizer,
                                            const RunContext& context, const IterationObserver& observer,
                                            bool records) {
  Problems problems;
  check_job(job, problems);
  check_pictures(technique_of(job.params), pictures, problems);
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  return guarded([&] { return compute_valid_job(job, pictures, rasterizer, context, observer, records); });
}

tl::expected<std::vector<Artifact>, Problems> write_artifacts(const Job& job, const Outcome& outcome,
                                                              const JobRequest& request, const RunContext& context) {
  Problems problems;
  check_request(technique_of(job.params), request, problems);
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  return guarded([&] { return write_valid_artifacts(outcome, request, context); });
}

Raster draw_picture(const Outcome& outcome, double png_scale) {
  Raster picture = draw_sheet(outcome.sheet, png_scale_of(outcome.sheet, png_scale));
  if (outcome.finish) outcome.finish(picture);
  return picture;
}

tl::expected<JobResult, Problems> run_job(const Job& job, const Pictures& pictures, const JobRequest& request,
                                          Rasterizer& rasterizer, const RunContext& context,
                                          const IterationObserver& observer) {
  Problems problems;
  check_job(job, problems);
  check_request(technique_of(job.params), request, problems);
  check_pictures(technique_of(job.params), pictures, problems);
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  const bool animated = std::find(request.formats.begin(), request.formats.end(), "apng") != request.formats.end();
  auto outcome = compute_job(job, pictures, rasterizer, part_of(context, 0, kTechniqueShare), observer, animated);
  if (!outcome) return tl::unexpected<Problems>(std::move(outcome.error()));
  auto artifacts = write_artifacts(job, *outcome, request, part_of(context, kTechniqueShare, 1));
  if (!artifacts) return tl::unexpected<Problems>(std::move(artifacts.error()));
  return JobResult{*std::move(artifacts), std::move(outcome->counts), std::move(outcome->metrics),
                   *std::move(outcome->done)};
}

}  // namespace tessera

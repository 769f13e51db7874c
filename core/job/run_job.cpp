#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "tessera/formats/formats.h"
#include "tessera/job/job_json.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

// The technique's own share of the progress; the rest is writing the formats.
constexpr double kTechniqueShare = 0.95;
constexpr double kMaxPngScale = 16;

struct Format {
  const char* name;
  const char* media_type;
  std::string (*write)(const PieceSheet& sheet, double png_scale);
};

const Format kFormats[] = {
    {"svg", "image/svg+xml", [](const PieceSheet& sheet, double) { return write_svg(sheet); }},
    {"dxf", "image/vnd.dxf", [](const PieceSheet& sheet, double) { return write_dxf(sheet); }},
    {"png", "image/png", [](const PieceSheet& sheet, double scale) { return write_png(sheet, scale); }},
    {"json", "application/geo+json", [](const PieceSheet& sheet, double) { return write_geojson(sheet); }},
    {"csv", "text/csv", [](const PieceSheet& sheet, double) { return write_csv(sheet); }},
};

// `name` is among the technique's formats.
const Format& format_of(const std::string& name) {
  return *std::find_if(std::begin(kFormats), std::end(kFormats), [&](const Format& f) { return f.name == name; });
}

// A small sheet is drawn larger, towards 2048 px, so that its pieces can be seen.
double png_scale_of(const PieceSheet& sheet, double asked) {
  if (asked > 0) return asked;
  return std::clamp(std::floor(2048 / std::max({sheet.width, sheet.height, 1.0})), 1.0, 4.0);
}

void check_seed(const Job& job, Problems& problems) {
  if (job.seed <= kMaxSeed) return;
  problems.push_back(
      {StatusCode::kInvalidParameter, "seed", fmt::format("is {}, expected 0 to {}", job.seed, kMaxSeed)});
}

void check_request(const Technique& technique, const JobRequest& request, Problems& problems) {
  const auto& known = technique.formats;
  for (const std::string& name : request.formats) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    problems.push_back({StatusCode::kInvalidParameter, name,
                        fmt::format("is no output of {}, expected {}", technique.name, either_of(known))});
  }
  if (!(request.png_scale >= 0 && request.png_scale <= kMaxPngScale)) {
    problems.push_back({StatusCode::kInvalidParameter, "pngScale",
                        fmt::format("is {}, expected 0 to {}", request.png_scale, kMaxPngScale)});
  }
}

void check_pictures(const Technique& technique, const Pictures& pictures, Problems& problems) {
  for (const InputRole& role : technique.inputs) {
    const auto found = pictures.find(std::string(role.name));
    const char* trouble = nullptr;
    if (found == pictures.end()) {
      trouble = "is missing, expected a picture";
    } else if (!found->second.pixels || found->second.width < 1 || found->second.height < 1) {
      trouble = "has no pixels, expected at least one";
    }
    if (trouble) problems.push_back({StatusCode::kInvalidInput, std::string(role.name), trouble});
  }
}

// The bare outputs: artifacts, counts and metrics of what the technique has made.
Result<JobResult> write_artifacts(const Job& job, const JobRequest& request, Outcome outcome,
                                  const RunContext& context) {
  outcome.sheet.job_json = job_to_text(job);
  const double scale = png_scale_of(outcome.sheet, request.png_scale);
  JobResult result;
  for (const std::string& name : request.formats) {
    if (auto go_on = context.check(); !go_on) return tl::unexpected<Status>(std::move(go_on.error()));
    const Format& format = format_of(name);
    result.artifacts.push_back({format.name, format.media_type, format.write(outcome.sheet, scale)});
  }
  if (request.plots) {
    for (const Plot& plot : outcome.plots) {
      result.artifacts.push_back(
          {fmt::format("plots/{}.svg", plot.name), "image/svg+xml", write_histogram_svg(plot.histogram)});
    }
  }
  result.counts = std::move(outcome.counts);
  result.metrics = std::move(outcome.metrics);
  return result;
}

Result<JobResult> run_valid_job(const Job& job, const Pictures& pictures, const JobRequest& request,
                                Rasterizer& rasterizer, const RunContext& context,
                                const IterationObserver& observer) {
  RunContext inner = context;
  inner.on_progress = [&](double fraction) { context.progress(kTechniqueShare * fraction); };
  auto outcome = technique_of(job.params).run(job, pictures, rasterizer, inner, observer);
  if (!outcome) return tl::unexpected<Status>(std::move(outcome.error()));
  context.stage("format");
  auto result = write_artifacts(job, request, *std::move(outcome), context);
  context.progress(1);
  return result;
}

}  // namespace

tl::expected<JobResult, Problems> run_job(const Job& job, const Pictures& pictures, const JobRequest& request,
                                          Rasterizer& rasterizer, const RunContext& context,
                                          const IterationObserver& observer) {
  Problems problems;
  const Technique& technique = technique_of(job.params);
  check_params(job.params, problems);
  check_seed(job, problems);
  check_request(technique, request, problems);
  check_pictures(technique, pictures, problems);
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  const auto fault = [](std::string message) {
    return tl::unexpected<Problems>(Problems{{StatusCode::kInternal, "", std::move(message)}});
  };
  try {
    auto result = run_valid_job(job, pictures, request, rasterizer, context, observer);
    if (result) return *std::move(result);
    return tl::unexpected<Problems>(Problems{std::move(result.error())});
  } catch (const std::bad_alloc&) {
    return fault("out of memory");
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) return fault("out of memory");
    return fault(fmt::format("OpenCV failed in {}: {}", error.func, error.err));
  }
}

}  // namespace tessera

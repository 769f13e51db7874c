#include "engine.h"

#include <utility>

#include "tessera/gpu/gl_rasterizer.h"
#include "tessera/job/guarded.h"
#include "tessera/job/techniques.h"
#include "tessera/voronoi/cpu_rasterizer.h"
#include "tessera/voronoi/fallback_rasterizer.h"

namespace tessera {

namespace {

ImageView view_of(const cv::Mat3b& picture) {
  return {picture.ptr(), picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
}

}  // namespace

Result<void> Engine::use_gl(bool software) {
  gl_is_software_ = software;
  auto rasterizer = make_gl_rasterizer();
  has_gl_ = rasterizer.has_value();
  return rasterizer.map([](const auto&) {});
}

std::unique_ptr<Rasterizer> Engine::make_rasterizer(BackendChoice choice, const RunContext& context) {
  auto cpu = make_cpu_rasterizer();
  const bool wanted = choice == BackendChoice::kGl || (choice == BackendChoice::kAuto && !gl_is_software_);
  if (!has_gl_ || !wanted) return cpu;
  const auto warn = [this, &context](const Status& reason) {
    has_gl_ = false;
    context.warn("drawing with the graphics card failed (" + reason.message + "), the processor takes over");
  };
  auto gl = make_gl_rasterizer();
  if (gl) return make_fallback_rasterizer(*std::move(gl), std::move(cpu), warn);
  warn(gl.error());
  return cpu;
}

void Engine::begin(RunContext& context) {
  stop_ = 0;
  context.stop = &stop_;
}

tl::expected<const Outcome*, Problems> Engine::run(const Job& job, BackendChoice choice, RunContext context,
                                                   const IterationObserver& observer, std::string& backend) {
  finished_.reset();  // its memory is wanted now
  begin(context);
  Pictures pictures;
  for (const auto& [role, picture] : pictures_) pictures[role] = view_of(picture);
  const auto rasterizer = make_rasterizer(choice, context);
  auto outcome = compute_job(job, pictures, *rasterizer, context, observer, /*records=*/true);
  if (!outcome) return tl::unexpected<Problems>(std::move(outcome.error()));
  backend = rasterizer->name();
  finished_ = Finished{job, *std::move(outcome)};
  return &finished_->outcome;
}

tl::expected<Artifact, Problems> Engine::artifact(const std::string& format) const {
  if (!finished_) {
    return tl::unexpected<Problems>(
        Problems{{StatusCode::kInvalidParameter, format, "has no run to come from, expected a finished one"}});
  }
  auto artifacts = write_artifacts(finished_->job, finished_->outcome, {.formats = {format}}, {});
  return artifacts.map([](std::vector<Artifact>& all) { return std::move(all.front()); });
}

tl::expected<Measured, Problems> Engine::measure(const cv::Mat3b& picture, const MeasureOptions& options,
                                                 RunContext context) {
  begin(context);
  return guarded([&] { return measure_picture(view_of(picture), options, context); });
}

tl::expected<Measured, Problems> Engine::measure(std::string_view file, const MeasureOptions& options,
                                                 RunContext context) {
  begin(context);
  return guarded([&]() -> Result<Measured> {
    const auto read = read_pattern_file(file);
    if (!read) return tl::unexpected<Status>(read.error());
    return measure_pattern(*read, options, context);
  });
}

tl::expected<Fit, Problems> Engine::fit(const cv::Mat3b& picture, std::uint64_t seed, RunContext context) {
  begin(context);
  return guarded([&] { return fit_pattern(view_of(picture), seed, context); });
}

}  // namespace tessera

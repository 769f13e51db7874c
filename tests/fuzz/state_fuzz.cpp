// What an interrupted parquetry has left, in the hands of somebody who knows the job's fingerprint: the run goes on,
// or says that it cannot.
#include "fuzz.h"
#include "tessera/job/job.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::fuzz {
namespace {

cv::Mat3b stripes(int width, int height) {
  cv::Mat3b picture(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(y, x) = cv::Vec3b::all(static_cast<std::uint8_t>(7 * x + 3 * y));
  return picture;
}

tl::expected<Outcome, Problems> run(std::string_view earlier) {
  static const cv::Mat3b target = stripes(20, 20), panel = stripes(60, 40);
  Job job;
  parquetry::Params params;
  params.image_size_mm = 20;
  params.patch_mm = 10;
  params.min_width_mm = 2;
  params.rotations = 2;
  params.adaptive_levels = 1;
  params.panels = "oak dpi=25.4";  // a millimetre a pixel
  job.params = params;
  RunContext context;
  context.earlier = earlier;
  return compute_job(job, {{"target", view_of(target)}, {"panel-oak", view_of(panel)}}, *make_cpu_rasterizer(),
                     context);
}

// The first two lines, by which a run knows its state again.
const std::string& head() {
  static const std::string lines = [] {
    const std::string state = run({}).value().state;
    return state.substr(0, state.find('\n', state.find('\n') + 1) + 1);
  }();
  return lines;
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera::fuzz;
  const auto outcome = run(head() + std::string(text_of(data, size)));
  if (!outcome) {
    require_messages(outcome.error());
  } else {
    for (const auto& file : outcome->folder()) require(!file.bytes.empty(), "files hold something");
  }
  return 0;
}

// The only entry into the techniques: small pictures, parameters within their ranges, every format. It ends in files
// or in reasons, and the job that comes out makes the same files again.
#include <algorithm>
#include <atomic>
#include <map>
#include <vector>

#include "fuzz.h"
#include "tessera/job/parameters.h"
#include "tessera/job/techniques.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::fuzz {
namespace {

// Where more of it is only slower.
const std::map<std::string, double, std::less<>> kEnough = {
    {"iterations", 2}, {"sites", 200},        {"tiles", 200},      {"width", 80},     {"height", 60},
    {"filter", 5},     {"intensity", 0.1},    {"scatter", 30},     {"prototypes", 5}, {"medianRadius", 5},
    {"rotations", 4},  {"imageSizeMm", 30},   {"improveTries", 3}, {"copies", 2},     {"adaptiveLevels", 2},
    {"family", 10},    {"resolutionDpi", 60}, {"supersample", 2},  {"settle", 2}};

double most(const Parameter& parameter) {
  const auto enough = kEnough.find(std::string_view(parameter.info.key));
  return std::max(parameter.info.min,
                  enough == kEnough.end() ? parameter.info.max : std::min(enough->second, parameter.info.max));
}

// An end of the range, where faults are, or somewhere between.
double draw_number(const Parameter& parameter, FuzzedDataProvider& data) {
  const double low = parameter.info.min, high = most(parameter);
  switch (data.ConsumeIntegralInRange(0, 3)) {
    case 0: return low;
    case 1: return high;
    default: return data.ConsumeFloatingPointInRange(low, high);
  }
}

std::string draw_text(FuzzedDataProvider& data) {
  std::string text = data.ConsumeRandomLengthString(40);
  for (char& c : text) c = static_cast<char>(c & 0x7F);
  return text;
}

Json draw(const Parameter& parameter, FuzzedDataProvider& data) {
  switch (parameter.kind) {
    case ParameterKind::kNumber: return draw_number(parameter, data);
    case ParameterKind::kInteger: return static_cast<std::int64_t>(draw_number(parameter, data));
    case ParameterKind::kFlag: return data.ConsumeBool();
    case ParameterKind::kText: return draw_text(data);
    case ParameterKind::kChoice:
      return parameter.choices[data.ConsumeIntegralInRange<std::size_t>(0, parameter.choices.size() - 1)].name;
  }
  return nullptr;
}

Job draw_job(const Technique& technique, FuzzedDataProvider& data) {
  Json params = Json::object();
  for (const Parameter& parameter : parameters_of(technique.defaults)) {
    const bool is_usual = kEnough.count(std::string_view(parameter.info.key)) == 0 && !data.ConsumeBool();
    if (!is_usual) params[parameter.info.key] = draw(parameter, data);
  }
  Job job{data.ConsumeIntegralInRange<std::uint64_t>(0, kMaxSeed), technique.defaults, {}};
  Problems problems;  // fields with a problem keep their value
  read_params(params, job.params, problems);
  if (auto* parquet = std::get_if<parquetry::Params>(&job.params); parquet && data.ConsumeBool())
    parquet->panels = "oak dpi=25.4";
  return job;
}

std::map<std::string, cv::Mat3b> draw_pictures(const Technique& technique, FuzzedDataProvider& data) {
  std::map<std::string, cv::Mat3b> pictures;
  for (const InputRole& role : technique.inputs) {
    const std::string name = std::string(role.name) + (role.many ? "-oak" : "");
    const bool is_large = role.name == "panel" || role.name == "mask";
    if (role.required || data.ConsumeBool()) pictures[name] = picture_from(data, is_large ? 64 : 24);
  }
  return pictures;
}

tl::expected<JobResult, Problems> run(const Job& job, const std::map<std::string, cv::Mat3b>& pictures, int steps) {
  Pictures views;
  for (const auto& [role, picture] : pictures) views[role] = view_of(picture);
  std::atomic<int> stop{0};
  RunContext context;
  context.stop = &stop;
  context.on_progress = [&](double) {
    if (--steps == 0) stop = static_cast<int>(StopReason::kCancelled);
  };
  context.on_warning = [](std::string_view message) { require(!message.empty(), "a warning says something"); };
  const JobRequest request{technique_of(job.params).formats, true, 0.5};
  return run_job(job, views, request, *make_cpu_rasterizer(), context);
}

void try_run(FuzzedDataProvider& data) {
  const Technique& technique = techniques()[data.ConsumeIntegralInRange<std::size_t>(0, techniques().size() - 1)];
  const bool is_stopped = data.ConsumeIntegralInRange(0, 7) == 0, again = data.ConsumeIntegralInRange(0, 7) == 0;
  const int steps = is_stopped ? data.ConsumeIntegralInRange(1, 100) : -1;
  const Job job = draw_job(technique, data);
  const auto pictures = draw_pictures(technique, data);
  const auto result = run(job, pictures, steps);
  if (!result) return require_messages(result.error());
  for (const Artifact& artifact : result->artifacts) require(!artifact.bytes.empty(), "files hold something");
  if (!again) return;
  const auto same = run(result->job, pictures, -1);
  require(same && same->artifacts.size() == result->artifacts.size(), "the job that comes out can be run");
  for (std::size_t i = 0; i < same->artifacts.size(); ++i)
    require(same->artifacts[i].bytes == result->artifacts[i].bytes, "the job that comes out makes the same files");
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider provider(data, size);
  tessera::fuzz::try_run(provider);
  return 0;
}

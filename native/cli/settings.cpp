#include "tessera/cli/settings.h"

#include <algorithm>

namespace tessera {
namespace {

constexpr std::uint64_t kDefaultMaxPixels = 100'000'000;

Parameter number(ParameterKind kind, const ParameterInfo& info, Json value) {
  return {info, kind, std::move(value), {}};
}

Parameter choice(const char* key, const char* help, std::vector<ParameterChoice> choices) {
  const char* first = choices.front().name;
  return {{.key = key, .help = help}, ParameterKind::kChoice, first, std::move(choices)};
}

}  // namespace

std::vector<Parameter> setting_flags() {
  using enum ParameterKind;
  return {
      number(kInteger, kSeedInfo, Job{}.seed),
      choice("backend", "What draws the diagram",
             {{"auto", "gl on graphics hardware, else cpu"}, {"cpu", "the processor"}, {"gl", "OpenGL ES"}}),
      number(kInteger, {.key = "threads", .min = 1, .max = 1024, .help = "Threads, all of them if not given"},
             nullptr),
      choice("progress", "A bar on standard error",
             {{"auto", "where it is a terminal"}, {"always", "in any case"}, {"never", "in no case"}}),
      number(kNumber,
             {.key = "maxPixels", .min = 1, .max = 1 << 30, .unit = "px", .help = "Larger pictures are refused"},
             kDefaultMaxPixels),
      number(kNumber,
             {.key = "pngScale",
              .min = 0.01,
              .max = kMaxPngScale,
              .help = "Pixels of a PNG to a pixel of the picture; a small one is drawn larger if not given"},
             nullptr),
      number(kNumber, {.key = "timeout", .min = 0.001, .max = 1e8, .unit = "s", .help = "Give up after this time"},
             nullptr),
  };
}

void read_settings(const Json& given, Settings& settings, Problems& problems) {
  Json values = Json::object();
  for (const Parameter& flag : setting_flags()) {
    const std::string key = flag.info.key;
    values[key] = flag.value;
    if (!given.contains(key)) continue;
    if (auto trouble = complaint(flag, given[key])) {
      problems.push_back({StatusCode::kInvalidParameter, key, *std::move(trouble)});
    } else {
      values[key] = given[key];
    }
  }
  if (given.contains("seed")) settings.seed = values["seed"].get<std::uint64_t>();
  const std::string backend = values["backend"], progress = values["progress"];
  if (backend == "cpu") settings.backend = BackendChoice::kCpu;
  if (backend == "gl") settings.backend = BackendChoice::kGl;
  if (progress == "always") settings.progress = ProgressMode::kAlways;
  if (progress == "never") settings.progress = ProgressMode::kNever;
  if (values["threads"].is_number()) settings.threads = static_cast<int>(values["threads"].get<double>());
  if (values["timeout"].is_number()) settings.timeout_s = values["timeout"].get<double>();
  if (values["pngScale"].is_number()) settings.png_scale = values["pngScale"].get<double>();
  settings.max_pixels = values["maxPixels"].get<std::uint64_t>();
}

}  // namespace tessera

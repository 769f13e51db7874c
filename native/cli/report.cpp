#include "tessera/cli/report.h"

#include <sys/resource.h>

#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/job/job_json.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

// Digits beyond a microsecond say nothing.
double rounded(double value) { return std::round(value * 1e3) / 1e3; }

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

Json inputs_json(const std::map<std::string, Input>& inputs) {
  Json list = Json::array();
  for (const auto& [role, input] : inputs) {
    list.push_back({{"path", input.path},
                    {"width", input.picture.width},
                    {"height", input.picture.height},
                    {"sha256", input.sha256}});
  }
  return list;
}

Json stages_json(const StageClock& clock) {
  Json list = Json::array();
  for (const StageTime& stage : clock.stages()) {
    list.push_back({{"name", stage.name}, {"ms", rounded(stage.ms)}, {"cpu_ms", rounded(stage.cpu_ms)}});
  }
  return list;
}

Json outputs_json(const std::vector<WrittenFile>& outputs) {
  Json list = Json::array();
  for (const WrittenFile& file : outputs) {
    list.push_back({{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  }
  return list;
}

}  // namespace

std::string write_report(const Job& job, std::string_view backend, const std::map<std::string, Input>& inputs,
                         const JobResult& result, const std::vector<WrittenFile>& outputs, const StageClock& clock) {
  const Json report = {{"tessera", TESSERA_VERSION},
                       {"technique", technique_of(job.params).name},
                       {"seed", job.seed},
                       {"backend", backend},
                       {"threads", cv::getNumThreads()},
                       {"inputs", inputs_json(inputs)},
                       {"params", write_params(job.params)},
                       {"stages", stages_json(clock)},
                       {"total_ms", rounded(clock.total_ms())},
                       {"peak_rss_mb", rounded(peak_rss_mb())},
                       {"counts", result.counts},
                       {"metrics", result.metrics},
                       {"outputs", outputs_json(outputs)}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tessera

// What a run did, as JSON.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/cli/inputs.h"
#include "tessera/cli/outputs.h"
#include "tessera/cli/stage_clock.h"
#include "tessera/job/job.h"

namespace tessera {

std::string write_report(const Job& job, std::string_view backend, const std::map<std::string, Input>& inputs,
                         const JobResult& result, const std::vector<WrittenFile>& outputs, const StageClock& clock);

}  // namespace tessera

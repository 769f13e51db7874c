// The pattern technique as a job.
#pragma once

#include "tessera/job/techniques.h"

namespace tessera {

TechniqueRun run_pattern_job;

}  // namespace tessera

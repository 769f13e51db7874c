// The pebbles technique as a job.
#pragma once

#include "tessera/job/techniques.h"

namespace tessera {

TechniqueRun run_pebbles_job;

}  // namespace tessera

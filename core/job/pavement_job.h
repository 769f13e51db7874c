// The pavement technique as a job.
#pragma once

#include "tessera/job/techniques.h"

namespace tessera {

TechniqueRun run_pavement_job;

}  // namespace tessera

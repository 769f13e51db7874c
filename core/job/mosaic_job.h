// The mosaic technique as a job.
#pragma once

#include "tessera/job/techniques.h"

namespace tessera {

TechniqueRun run_mosaic_job;

}  // namespace tessera

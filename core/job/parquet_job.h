// The parquetry technique as a job.
#pragma once

#include <vector>

#include "tessera/job/techniques.h"

namespace tessera {

TechniqueRun run_parquet_job;

// "plan": how many pieces, how much wood and cutting, without panels. "forecast": whether the panels suffice.
std::vector<Question> parquet_questions();

}  // namespace tessera

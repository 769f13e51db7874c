// The parquetry technique as a job.
#pragma once

#include <memory>
#include <vector>

#include "tessera/job/techniques.h"
#include "tessera/parquetry/live_grid.h"

namespace tessera {

TechniqueRun run_parquet_job;

// "plan": how many pieces, how much wood and cutting, without panels. "forecast": whether the panels suffice.
std::vector<Question> parquet_questions();

// Begins the job's morphed grid for people to work on; that of the first of several targets. What `grid` has found
// before is kept where it is still right. Fails as the job would; kInvalidParameter for `grid` where it is regular.
Result<void> begin_live_grid(const Job& job, const Pictures& pictures, std::unique_ptr<parquetry::LiveGrid>& grid);

}  // namespace tessera

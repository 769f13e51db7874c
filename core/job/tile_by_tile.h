// Jobs on pictures too large for memory: rows of pixels in, bytes out as they are made.
#pragma once

#include <functional>
#include <string_view>

#include "tessera/image/row_source.h"
#include "tessera/job/job.h"

namespace tessera {

// Whether the job asks for tiles, so that it can be run so.
bool goes_tile_by_tile(const Job& job);

// The next bytes of a file; an error ends the run.
using TakeBytes = std::function<Result<void>(std::string_view bytes)>;

// The SVG of run_job(), byte by byte, of a job that goes tile by tile. The result has no artifacts. Errors as there,
// and those of the source and of `svg`.
tl::expected<JobResult, Problems> run_tile_by_tile(const Job& job, RowSource& drawing, Rasterizer& rasterizer,
                                                   const RunContext& context, const TakeBytes& svg);

}  // namespace tessera

// `--panel SCAN[,mask=M.png,dpi=300,name=oak]`: scans of wood with what is known of them.
#pragma once

#include <string>
#include <vector>

#include "tessera/base/status.h"
#include "tessera/job/job.h"

namespace tessera {

// Puts each panel into the job: its scan and mask as inputs panel-NAME and mask-NAME, everything else as an entry of
// `options`, the parameter `panels`. A panel without a name has its file's. A comma belongs to the path unless one of
// the words that are known and '=' follow it. Adds every problem there is.
void take_panels(const std::vector<std::string>& given, Job& job, std::string& options, Problems& problems);

}  // namespace tessera

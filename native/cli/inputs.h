// The pictures of a job, from its paths.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "tessera/io/picture.h"
#include "tessera/job/job.h"

namespace tessera {

struct Input {
  std::string path;    // as the job names it
  std::string sha256;  // of the file; empty where it was not asked for
  Picture picture;
};

// By role. A relative path is looked for in `folder` first (empty: none), then in the current one. All problems are
// reported together, with the path as their field.
tl::expected<std::map<std::string, Input>, Problems> read_inputs(const Job& job, const std::string& folder,
                                                                 std::uint64_t max_pixels, bool with_checksums);

}  // namespace tessera

// The pictures of a job, from its paths.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "tessera/image/row_source.h"
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

// The one input of a job that goes tile by tile, its rows to be read as they are wanted; null where the file does not
// come in rows. The picture of `input` has its size only.
Result<std::unique_ptr<RowSource>> open_rows(const Job& job, const std::string& folder, bool with_checksum,
                                             Input& input);

}  // namespace tessera

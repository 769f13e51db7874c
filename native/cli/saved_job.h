// A job from a file, with the changes asked for.
#pragma once

#include <string>
#include <vector>

#include "tessera/job/job.h"

namespace tessera {

// Reads a job's JSON, or an SVG with one, from `path` ("-": standard input), and sets each "key=value": a parameter,
// an input's role or "seed". All problems of one kind are reported together.
tl::expected<Job, Problems> load_job(const std::string& path, const std::vector<std::string>& changes);
// The same of the text that the file at `path` holds.
tl::expected<Job, Problems> read_saved_job(const std::string& text, const std::string& path,
                                           const std::vector<std::string>& changes);

}  // namespace tessera

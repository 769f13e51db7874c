// Jobs as text: what is saved, opened again and carried inside an SVG.
//
//   {"schemaVersion": 1, "technique": "pavement", "seed": 1, "params": {"halfSide": 4, ...}, "inputs": {"drawing":
//   "a.png"}}
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tessera/job/job.h"
#include "tessera/job/parameters.h"

namespace tessera {

// A larger or deeper text is refused before it is parsed.
inline constexpr std::size_t kMaxJobBytes = std::size_t{1} << 20;
inline constexpr int kMaxJobDepth = 16;

// The whole job with every parameter, members in a fixed order; as text in one line, or indented to be read by
// people.
Json job_to_json(const Job& job);
enum class Layout { kOneLine, kIndented };
std::string job_to_text(const Job& job, Layout layout = Layout::kOneLine);

// Reads a job from JSON, or from an SVG that carries one. schemaVersion and technique must be there, other members
// have defaults. Text that is no job at all is kInvalidInput, a member or parameter that cannot be is
// kInvalidParameter; all of the latter are reported together.
tl::expected<Job, Problems> read_job(std::string_view text);

// JSON of a job's size and depth, no key twice; else kInvalidInput.
Result<Json> parse_json(std::string_view text);

// The job's JSON from the <metadata> of an SVG. Strict and simple: no entities but XML's own, no internal DTD.
Result<std::string> extract_job_from_svg(std::string_view svg);

}  // namespace tessera

// What machines and people read about jobs and parameters: JSON Schema, and docs/parameters.md.
#pragma once

#include <string>

#include "tessera/job/parameters.h"
#include "tessera/job/techniques.h"

namespace tessera {

// JSON Schema (draft 2020-12) of a technique's `params`. Beyond the standard's words: x-unit, x-ui-minimum,
// x-ui-maximum, x-symbol, x-advanced, and x-enum-descriptions, one text a value of `enum`.
Json params_schema(const Technique& technique);
// JSON Schema of a job; $defs holds each technique's params_schema under the technique's name.
Json job_schema();
// Every technique's parameters as Markdown.
std::string parameter_reference();

}  // namespace tessera

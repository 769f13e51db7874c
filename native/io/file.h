// Whole files into memory.
#pragma once

#include <string>

#include "tessera/base/status.h"

namespace tessera {

// How messages call an input: its path, or "standard input" for "-".
std::string input_name(const std::string& path);

// The bytes of the file at `path`, or of standard input where it is "-". kInvalidInput, with input_name() as its
// field, where it cannot be read or holds more than 4 GiB; kCancelled where a signal came while it waited.
Result<std::string> read_file(const std::string& path);

}  // namespace tessera

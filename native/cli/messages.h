// What is said on standard error, and the exit status that goes with it.
#pragma once

#include <string>
#include <string_view>

#include "tessera/base/status.h"

namespace tessera {

inline constexpr int kExitDone = 0;
inline constexpr int kExitUsage = 2;

int exit_status(StatusCode code);

// One line, "tessera: WHAT"; control characters cannot break it.
void print_message(std::string_view message);
// One line a problem, "tessera: FIELD: MESSAGE"; the exit status of the first one.
int print_problems(const Problems& problems);

}  // namespace tessera

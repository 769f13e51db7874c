// Completion of the command line in shells.
#pragma once

#include <string>
#include <string_view>

#include "tessera/cli/usage.h"

namespace tessera {

// The script that teaches the shell, one of shells(), commands, flags and the values that can be chosen.
std::string completion_script(std::string_view shell, const Usage& usage);

}  // namespace tessera

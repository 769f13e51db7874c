// The manual page, in the language of man(7).
#pragma once

#include <string>

#include "tessera/cli/usage.h"

namespace tessera {

// tessera.1: one page for all commands.
std::string man_page(const Usage& usage);

}  // namespace tessera

// Small texts that people write into parameters.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/colour.h"

namespace tessera {

// The words between any of the separators; none is empty.
std::vector<std::string_view> split(std::string_view text, std::string_view separators);

// "#rrggbb", "#rgb", with or without '#'. False, and `colour` stays, for anything else.
bool parse_colour(std::string_view text, Rgb& colour);
// The same, or "#rrggbbaa": how opaque it is, 255 where nothing is said.
bool parse_colour(std::string_view text, Rgb& colour, std::uint8_t& opacity);

// "#rrggbb"
std::string colour_text(Rgb colour);

// A decimal number, the whole text. False, and `value` stays, for anything else.
bool parse_number(std::string_view text, double& value);

}  // namespace tessera

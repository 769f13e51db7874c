#include "tessera/base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace tessera {

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return words;
}

bool parse_colour(std::string_view text, Rgb& colour) {
  if (!text.empty() && text.front() == '#') text.remove_prefix(1);
  if (text.size() != 3 && text.size() != 6) return false;
  unsigned value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc() || stop != text.data() + text.size()) return false;
  const auto byte = [](unsigned v) { return static_cast<std::uint8_t>(v & 0xff); };
  if (text.size() == 3) {
    colour = {byte((value >> 8 & 0xf) * 17), byte((value >> 4 & 0xf) * 17), byte((value & 0xf) * 17)};
  } else {
    colour = {byte(value >> 16), byte(value >> 8), byte(value)};
  }
  return true;
}

bool parse_colour(std::string_view text, Rgb& colour, std::uint8_t& opacity) {
  const std::size_t mark = text.starts_with('#') ? 1 : 0;
  unsigned value = 255;
  if (text.size() == mark + 8) {
    const char *const begin = text.data() + mark + 6, *const end = begin + 2;
    if (const auto [stop, error] = std::from_chars(begin, end, value, 16); error != std::errc() || stop != end)
      return false;
    text.remove_suffix(2);
  }
  if (!parse_colour(text, colour)) return false;
  opacity = static_cast<std::uint8_t>(value);
  return true;
}

std::string colour_text(Rgb colour) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t level : {colour.r, colour.g, colour.b}) {
    text += kHex[level >> 4];
    text += kHex[level & 15];
  }
  return text;
}

bool parse_number(std::string_view text, double& value) {
  // from_chars of a double is missing in older libraries of one of our targets.
  if (text.empty() || text.size() > 32 || text.find_first_not_of("0123456789.+-eE") != std::string_view::npos)
    return false;
  const std::string copy(text);
  char* stop = nullptr;
  const double number = std::strtod(copy.c_str(), &stop);
  if (*stop != '\0' || !std::isfinite(number)) return false;
  value = number;
  return true;
}

}  // namespace tessera

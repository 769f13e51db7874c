#include "tessera/cli/panel_flags.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include "tessera/job/parameters.h"
#include "tessera/parquetry/panel_options.h"

namespace tessera {
namespace {

constexpr std::array<std::string_view, 6> kWords = {"mask", "dpi", "name", "margin", "marks", "machine"};

// Where ",word=" begins, from `from` on; npos: nowhere.
std::size_t next_option(const std::string& text, std::size_t from) {
  for (std::size_t comma = text.find(',', from); comma != std::string::npos; comma = text.find(',', comma + 1))
    for (const std::string_view word : kWords)
      if (text.compare(comma + 1, word.size(), word) == 0 && text[comma + 1 + word.size()] == '=') return comma;
  return std::string::npos;
}

// "scan.jpg", then each word and its value.
std::vector<std::pair<std::string, std::string>> taken_apart(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(next_option(text, at), text.size());
    const std::string part = text.substr(at, end - at);
    const std::size_t equals = part.find('=');
    if (parts.empty())
      parts.emplace_back("", part);
    else
      parts.emplace_back(part.substr(0, equals), part.substr(equals + 1));
    at = end + 1;
  }
  return parts;
}

// "scan 3.jpg" is called scan_3, or scan_3-2 where that is taken.
std::string name_of_file(const std::string& path, const Job& job) {
  std::string stem = path == "-" ? "panel" : std::filesystem::path(path).stem().string().substr(0, 30);
  for (char& c : stem)
    if (!parquetry::is_panel_name({&c, 1})) c = '_';
  if (stem.empty()) stem = "panel";
  std::string name = stem;
  for (int k = 2; job.inputs.count("panel-" + name) != 0; ++k) name = stem + "-" + std::to_string(k);
  return name;
}

}  // namespace

void take_panels(const std::vector<std::string>& given, Job& job, std::string& options, Problems& problems) {
  const auto refuse = [&](const std::string& text, std::string message) {
    problems.push_back({StatusCode::kInvalidParameter, text, std::move(message) + " (--panel)"});
  };
  for (const std::string& text : given) {
    std::string name, mask, rest;
    const auto parts = taken_apart(text);
    for (const auto& [word, value] : parts) {
      if (word == "name") {
        if (!parquetry::is_panel_name(value))
          refuse(text, "has the name " + shown(value) + ", expected letters, digits, - and _");
        name = value;
      } else if (word == "mask") {
        mask = value;
      } else if (!word.empty()) {
        rest.append(" ").append(word).append("=").append(value);
      }
    }
    const std::string& scan = parts.front().second;
    if (scan.empty()) refuse(text, "names no scan, expected SCAN[,mask=M.png,dpi=300,name=oak]");
    if (name.empty()) name = name_of_file(scan, job);
    if (!job.inputs.emplace("panel-" + name, scan).second)
      refuse(text, "is a second panel called " + name + ", expected a name of its own");
    if (!mask.empty()) job.inputs["mask-" + name] = mask;
    if (!rest.empty()) options.append(options.empty() ? "" : "; ").append(name).append(rest);
  }
}

}  // namespace tessera

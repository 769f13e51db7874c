// What is known of each panel beside its picture, as people write it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/geometry/point.h"

namespace tessera::parquetry {

struct PanelOptions {
  std::string name;
  double dpi = 0;                           // 0: the file says it
  double margin_mm = 0;                     // not used along the edges of the wood
  std::optional<std::vector<Point>> marks;  // its fiducials on the scan, px; else they are found
  std::vector<Point> machine;  // where these lie on the machine, mm; empty: the panel lies as it was scanned
};

// "oak dpi=300 margin=5; walnut machine=10:10,160:10,10:110": an entry a panel, a word an option. report(message)
// hears of everything that is wrong, one line each.
std::vector<PanelOptions> read_panel_options(std::string_view text,
                                             const std::function<void(std::string)>& report = {});

// Whether a panel may be called so: letters, digits, '-' and '_', 1 to 40 of them.
bool is_panel_name(std::string_view name);

}  // namespace tessera::parquetry

// Files that are measured: GeoJSON, lists of points, CSV and SVG.
#include "fuzz.h"
#include "tessera/job/guarded.h"
#include "tessera/job/measure.h"
#include "tessera/job/pattern_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera;
  const auto file = read_pattern_file(fuzz::text_of(data, size));
  if (!file) {
    fuzz::require_message(file.error());
    return 0;
  }
  fuzz::require(file->cells.empty() != file->points.empty(), "there are cells or points");
  MeasureOptions options;
  options.needles = 20;
  const auto measured = measure_pattern(*file, options, {});
  if (!measured) {
    fuzz::require_message(measured.error());
  } else {
    fuzz::require(!measured->json.dump().empty() && !measured->csv.empty(), "what was measured is told");
  }
  return 0;
}

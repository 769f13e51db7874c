// What is asked of a picture, as JSON, and the picture.
#include <algorithm>

#include "fuzz.h"
#include "tessera/job/job_json.h"
#include "tessera/job/measure.h"

namespace tessera::fuzz {
namespace {

void try_measure(const cv::Mat3b& picture, const std::string& text) {
  const auto json = parse_json(text);
  if (!json) return require_message(json.error());
  auto options = read_measure_options(*json);
  if (!options) return require_messages(options.error());
  options->needles = std::min(options->needles, 50);  // of which more only take time
  options->distances.resize(std::min<std::size_t>(options->distances.size(), 8));
  const auto measured = measure_picture(view_of(picture), *options, {});
  if (!measured) return require_message(measured.error());
  require(!measured->json.dump().empty() && !measured->csv.empty(), "what was measured is told");
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider provider(data, size);
  const cv::Mat3b picture = tessera::fuzz::picture_from(provider, 24);
  tessera::fuzz::try_measure(picture, provider.ConsumeRemainingBytesAsString());
  return 0;
}

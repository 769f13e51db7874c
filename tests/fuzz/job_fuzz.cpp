// Jobs as JSON and inside an SVG: what is read is written and read again the same.
#include "fuzz.h"
#include "tessera/job/job_json.h"

namespace tessera::fuzz {
namespace {

void try_job(std::string_view text) {
  const auto job = read_job(text);
  if (!job) return require_messages(job.error());
  const std::string written = job_to_text(*job);
  const auto again = read_job(written);
  require(again.has_value(), "a job that was written can be read");
  require(job_to_text(*again) == written, "a job that was read is written the same");
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tessera::fuzz::try_job(tessera::fuzz::text_of(data, size));
  return 0;
}

#include "tessera/cli/inputs.h"

#include <filesystem>
#include <utility>

#include "tessera/io/file.h"
#include "tessera/io/sha256.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

std::string located(const std::string& path, const std::string& folder) {
  if (path == "-" || folder.empty()) return path;
  const auto beside = std::filesystem::path(folder) / path;  // an absolute path stays what it is
  std::error_code error;
  return std::filesystem::exists(beside, error) ? beside.string() : path;
}

Result<Input> read_input(const std::string& path, const std::string& folder, std::uint64_t max_pixels, bool numbers,
                         bool with_checksum) {
  auto file = read_file(located(path, folder));
  if (!file) return tl::unexpected<Status>(std::move(file.error()));
  const std::string& bytes = *file;
  const auto decode = numbers ? decode_numbers : decode_picture;
  auto picture = decode({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, max_pixels);
  if (!picture) return fail(picture.error().code, input_name(path), picture.error().message);
  return Input{path, with_checksum ? sha256_hex(bytes) : "", *std::move(picture)};
}

}  // namespace

tl::expected<std::map<std::string, Input>, Problems> read_inputs(const Job& job, const std::string& folder,
                                                                 std::uint64_t max_pixels, bool with_checksums) {
  std::map<std::string, Input> inputs;
  Problems problems;
  for (const auto& [role, path] : job.inputs) {
    const InputRole* known = role_of(technique_of(job.params), role);
    auto input = read_input(path, folder, max_pixels, known && known->numbers, with_checksums);
    if (input) {
      inputs.emplace(role, *std::move(input));
    } else {
      problems.push_back(std::move(input.error()));
    }
  }
  if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));
  return inputs;
}

}  // namespace tessera

#include "tessera/cli/inputs.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "tessera/io/file.h"
#include "tessera/io/sha256.h"
#include "tessera/job/shapes.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

std::string located(const std::string& path, const std::string& folder) {
  if (path == "-" || folder.empty()) return path;
  const auto beside = std::filesystem::path(folder) / path;  // an absolute path stays what it is
  std::error_code error;
  return std::filesystem::exists(beside, error) ? beside.string() : path;
}

Result<Picture> painted(std::string_view svg, std::uint64_t max_pixels) {
  auto raster = read_shapes(svg, max_pixels);
  if (!raster) return tl::unexpected<Status>(std::move(raster.error()));
  Picture picture{raster->width, raster->height, std::make_unique<std::uint8_t[]>(raster->bytes.size())};
  std::copy(raster->bytes.begin(), raster->bytes.end(), picture.rgb.get());
  return picture;
}

Result<Picture> decoded(const std::string& bytes, std::uint64_t max_pixels, const InputRole* role) {
  if (role && role->shapes && looks_like_svg(bytes)) return painted(bytes, max_pixels);
  const auto decode = role && role->numbers ? decode_numbers : decode_picture;
  return decode({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, max_pixels);
}

Result<Input> read_input(const std::string& path, const std::string& folder, std::uint64_t max_pixels,
                         const InputRole* role, bool with_checksum) {
  auto file = read_file(located(path, folder));
  if (!file) return tl::unexpected<Status>(std::move(file.error()));
  const std::string& bytes = *file;
  auto picture = decoded(bytes, max_pixels, role);
  if (!picture) return fail(picture.error().code, input_name(path), picture.error().message);
  return Input{path, with_checksum ? sha256_hex(bytes) : "", *std::move(picture)};
}

}  // namespace

tl::expected<std::map<std::string, Input>, Problems> read_inputs(const Job& job, const std::string& folder,
                                                                 std::uint64_t max_pixels, bool with_checksums) {
  std::map<std::string, Input> inputs;
  Problems problems;
  for (const auto& [role, path] : job.inputs) {
    auto input = read_input(path, folder, max_pixels, role_of(technique_of(job.params), role), with_checksums);
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

#include "tessera/cli/inputs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "tessera/io/file.h"
#include "tessera/io/png_rows.h"
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

// Of a file that need not fit into memory.
Result<std::string> sha256_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Sha256 sum;
  std::vector<char> some(1 << 20);
  while (file) {
    file.read(some.data(), static_cast<std::streamsize>(some.size()));
    sum.add({some.data(), static_cast<std::size_t>(file.gcount())});
  }
  if (!file.eof()) return fail(StatusCode::kInvalidInput, path, "cannot be read");
  return sum.hex();
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

Result<std::unique_ptr<RowSource>> open_rows(const Job& job, const std::string& folder, bool with_checksum,
                                             Input& input) {
  const auto drawing = job.inputs.find("drawing");
  if (job.inputs.size() != 1 || drawing == job.inputs.end()) return std::unique_ptr<RowSource>();
  const std::string path = located(drawing->second, folder);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::unique_ptr<RowSource>();
  auto rows = open_png_rows(path);
  if (!rows || !*rows) return rows;
  input.path = drawing->second;
  input.picture.width = (*rows)->size().width;
  input.picture.height = (*rows)->size().height;
  if (with_checksum) {
    auto sum = sha256_of_file(path);
    if (!sum) return tl::unexpected<Status>(std::move(sum.error()));
    input.sha256 = *std::move(sum);
  }
  return rows;
}

}  // namespace tessera

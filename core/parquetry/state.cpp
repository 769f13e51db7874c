#include "tessera/parquetry/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/text.h"
#include "tessera/parquetry/frames.h"
#include "tessera/parquetry/patches.h"

namespace tessera::parquetry {
namespace {

constexpr std::string_view kFirstLine = "tessera parquetry state 2";
constexpr std::size_t kNumbers = 19;

// Patches and all the quarters of them, as far as they are asked for.
std::optional<Patch> find(const std::vector<Patch>& patches, const Patch& wanted, const Params& params,
                          double mm_per_px) {
  for (const Patch& patch : patches) {
    if (patch.target != wanted.target || patch.row != wanted.row || patch.column != wanted.column ||
        patch.part != wanted.part)
      continue;
    if (patch.level == wanted.level && patch.box == wanted.box) return patch;
    if (patch.level >= wanted.level || (patch.box & wanted.box).empty()) continue;
    if (auto quarter = find(quarters(patch, params, mm_per_px), wanted, params, mm_per_px)) return quarter;
  }
  return std::nullopt;
}

// All of them small enough for whole numbers, sums of two included.
bool read_numbers(std::string_view line, std::vector<double>& numbers) {
  constexpr std::size_t kCost = 13;
  constexpr double kMost = 1e9, kMostCost = 4e18;
  numbers.clear();
  for (const std::string_view word : split(line, " ")) {
    double number = 0;
    if (!parse_number(word, number) || !(std::abs(number) <= (numbers.size() == kCost ? kMostCost : kMost)))
      return false;
    numbers.push_back(number);
  }
  return numbers.size() == kNumbers;
}

bool is_possible(const Laid& laid, const std::vector<Panel>& panels, const Params& params) {
  const auto& [patch, placement] = laid;
  if (placement.panel == -1) return true;
  if (placement.panel < 0 || placement.panel >= static_cast<int>(panels.size())) return false;
  const std::vector<int> rotations = allowed_rotations(params);
  if (std::find(rotations.begin(), rotations.end(), placement.rotation) == rotations.end()) return false;
  const cv::Size scan = panels[static_cast<std::size_t>(placement.panel)].scan.size();
  const Turn turn(scan, degrees_of(placement.rotation, params));
  const cv::Rect box(placement.at, patch.box.size());
  if ((box & cv::Rect({}, turn.size())) != box) return false;
  const Point middle{patch.box.x + 0.5 * patch.box.width, patch.box.y + 0.5 * patch.box.height};
  const Placement same = place(turn, placement.rotation, patch.box.size(), placement.at, middle);
  constexpr double kRounding = 1e-6;
  const Ring ring = on_panel(placement, patch.outline).outer;
  return length(placement.from - same.from) <= kRounding && length(placement.to - same.to) <= kRounding &&
         std::abs(placement.turn_deg - same.turn_deg) <= kRounding &&
         std::all_of(ring.begin(), ring.end(),
                     [&](Point p) { return p.x >= 0 && p.y >= 0 && p.x <= scan.width && p.y <= scan.height; });
}

}  // namespace

std::uint64_t fingerprint_of(std::string_view bytes, std::uint64_t before) {
  for (const char c : bytes) before = (before ^ static_cast<std::uint8_t>(c)) * 1099511628211U;
  return before;
}

std::uint64_t fingerprint_of(const cv::Mat& pixels, std::uint64_t before) {
  before = fingerprint_of(fmt::format("{}x{}", pixels.cols, pixels.rows), before);
  for (int y = 0; y < pixels.rows; ++y)
    before = fingerprint_of({pixels.ptr<char>(y), static_cast<std::size_t>(pixels.cols) * pixels.elemSize()}, before);
  return before;
}

std::string write_state(std::uint64_t fingerprint, const std::vector<Laid>& laid) {
  std::string out = fmt::format("{}\n{:016x}\n", kFirstLine, fingerprint);
  for (const auto& [patch, p] : laid)
    out += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", patch.target, patch.row,
                       patch.column, patch.part, patch.level, patch.box.x, patch.box.y, patch.box.width,
                       patch.box.height, p.panel, p.rotation, p.at.x, p.at.y, p.cost, p.turn_deg, p.from.x, p.from.y,
                       p.to.x, p.to.y);
  return out;
}

std::optional<std::vector<Laid>> read_state(std::string_view text, std::uint64_t fingerprint,
                                            const std::vector<Patch>& patches, const Params& params,
                                            double mm_per_px) {
  const auto lines = split(text, "\n");
  if (lines.size() < 2 || lines[0] != kFirstLine || lines[1] != fmt::format("{:016x}", fingerprint))
    return std::nullopt;
  std::vector<Laid> laid;
  std::vector<double> n;
  for (std::size_t i = 2; i < lines.size(); ++i) {
    if (!read_numbers(lines[i], n)) return std::nullopt;
    const auto whole = [&](std::size_t k) { return static_cast<int>(n[k]); };
    Patch wanted;
    wanted.target = whole(0), wanted.row = whole(1), wanted.column = whole(2), wanted.part = whole(3);
    wanted.level = whole(4), wanted.box = {whole(5), whole(6), whole(7), whole(8)};
    const auto patch = find(patches, wanted, params, mm_per_px);
    if (!patch) return std::nullopt;
    Placement placement;
    placement.panel = whole(9), placement.rotation = whole(10), placement.at = {whole(11), whole(12)};
    placement.cost = static_cast<std::int64_t>(n[13]), placement.turn_deg = n[14];
    placement.from = {n[15], n[16]}, placement.to = {n[17], n[18]};
    laid.push_back({*patch, placement});
  }
  return laid;
}

bool are_possible(const std::vector<Laid>& laid, const std::vector<Panel>& panels, const Params& params) {
  return std::all_of(laid.begin(), laid.end(), [&](const Laid& one) { return is_possible(one, panels, params); });
}

}  // namespace tessera::parquetry

// A run of the matching, put aside.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/parquetry/assign.h"

namespace tessera::parquetry {

// What was laid, as text. `fingerprint` tells requests apart.
std::string write_state(std::uint64_t fingerprint, const std::vector<Laid>& laid);

// The same of patches that are among `patches` or quarters of these. Nothing where the text is no state, one of
// another fingerprint, or names a patch that is not there.
std::optional<std::vector<Laid>> read_state(std::string_view text, std::uint64_t fingerprint,
                                            const std::vector<Patch>& patches, const Params& params,
                                            double mm_per_px);

// Whether all lie where a run with these panels and parameters may lay them: on a panel, in a rotation that is
// allowed. A state that a person or a broken disk has changed need not.
bool are_possible(const std::vector<Laid>& laid, const std::vector<Panel>& panels, const Params& params);

// Of bytes (FNV-1a), going on from `before`.
inline constexpr std::uint64_t kNoFingerprint = 14695981039346656037U;
std::uint64_t fingerprint_of(std::string_view bytes, std::uint64_t before = kNoFingerprint);
std::uint64_t fingerprint_of(const cv::Mat& pixels, std::uint64_t before);

}  // namespace tessera::parquetry

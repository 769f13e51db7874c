// What must be known of a whole drawing before a part of it can be paved as the whole would be.
#pragma once

#include <cstdint>

#include "tessera/image/row_source.h"
#include "tessera/pavement/fields.h"
#include "tessera/pavement/params.h"

namespace tessera::pavement {

struct Whole {
  cv::Size source;  // px
  int scale = 1;    // pixels of the diagram a source pixel
  ZoneRule rule;
  NoiseDirection noise;

  cv::Size diagram() const { return source * scale; }
};

// Looks through the rows a few times, some at a time. `params` have their half side. Errors are those of the source
// and of the context.
Result<Whole> look_through(RowSource& source, const Params& params, std::uint64_t seed, const RunContext& context);

// The fields of a part, in source pixels, of rows that are at hand. What is within kPartMargin px of its border or
// nearer than distances that matter may differ from the whole's, unless that ends there, too.
inline constexpr int kPartMargin = 4;
Fields fields_of_part(const RowWindow& rows, cv::Rect part, const Whole& whole, const Params& params);

}  // namespace tessera::pavement

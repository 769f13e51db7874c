// `tessera measure`: statistics of a picture, of cells or of points, beside a model's closed forms.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/image/image_view.h"
#include "tessera/job/job.h"
#include "tessera/job/parameters.h"
#include "tessera/job/pattern_file.h"
#include "tessera/statistics/closed_forms.h"

namespace tessera {

// A model to compare with, and its one number.
struct Comparison {
  statistics::CellModel model;
  double x = 0;  // > 0
};

struct MeasureOptions {
  std::optional<Comparison> comparison;  // of a file with a pattern's job in it the job's, where none is given
  std::vector<double> distances;         // of needles, or radii, > 0; empty: 24 of them that suit the size
  int needles = 40000;                   // a distance
  int colors = 0;                        // of a picture; 0: as many as it has
  double width = 0, height = 0;          // of the window; 0: what the file says, else where its points lie
  std::uint64_t seed = 1;
};

// From {"model": "occupancy", "lambda": 0.01, "distances": [1, 2], "window": [300, 200], "needles": 40000, "colors":
// 4, "seed": 1}, every member as it likes; `lambda` is the model's number. All problems together, by the member.
tl::expected<MeasureOptions, Problems> read_measure_options(const Json& json);

struct Measured {
  Json json;                // {"kind": "picture" | "cells" | "points", ...}
  std::string csv;          // a row a distance
  std::vector<Plot> plots;  // closed forms beside what was measured
};

Result<Measured> measure_picture(const ImageView& picture, const MeasureOptions& options, const RunContext& context);
Result<Measured> measure_pattern(const PatternFile& file, const MeasureOptions& options, const RunContext& context);

}  // namespace tessera

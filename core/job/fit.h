// `tessera fit`: which model of random geometry a picture looks like, and with which number (section 6).
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/image/image_view.h"
#include "tessera/job/job.h"
#include "tessera/job/parameters.h"
#include "tessera/patterns/params.h"

namespace tessera {

// How well a model explains a picture.
struct Candidate {
  patterns::Model model;
  double number = 0;  // its intensity, px and seconds as patterns::Params has it (speed 1), or the side of its cells
  double distance = 0;  // of its own pictures' marks to the picture's, in standard deviations; the least is the best
  double residual = 0;  // root mean square of W(d) less the model's, over the needles' lengths
};

struct Fit {
  std::vector<Candidate> candidates;  // the best first
  patterns::Params params;            // of the best: generates more of the same, as large as the picture
};

// Statistics of the picture are held against those of pictures that each cell model makes with the same density,
// colours and size; the number is then the one whose W(d) is nearest. A picture of two colours may also be one of discs,
// whose intensity and radius follow from how much they cover and how long their borders are. Wants a picture of a few
// colours with at least some dozens of cells; kInvalidInput where no borders are found.
Result<Fit> fit_pattern(const ImageView& picture, std::uint64_t seed, const RunContext& context);

// The job that generates more of the same.
Job job_of(const Fit& fit, std::uint64_t seed);
// {"model", "lambda", "candidates": [{"model", "lambda", "distance", "w_residual"}, ...], "job"}
Json fit_to_json(const Fit& fit, std::uint64_t seed);

}  // namespace tessera

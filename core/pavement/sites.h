// Where the stones' sites begin: at random, one for each stone's worth of area.
#pragma once

#include "tessera/pavement/fields.h"
#include "tessera/voronoi/site.h"

namespace tessera::pavement {

// h as the parameter says, or from the number of stones where that is given (Eq. 1 solved for h); source pixels.
double half_side_of(cv::Size source, const Params& params);

// Sites in their zones; thin zones get as many as stones of their own width need. Positions are random within strata
// of one stone's area each, so that no hole of several stones is left for the iterations to fill.
Sites first_sites(const Fields& fields, const Params& params, std::uint64_t seed);

}  // namespace tessera::pavement

// Better than first come, first served: who lost most comes first the next time.
#pragma once

#include <functional>
#include <vector>

#include "tessera/parquetry/assign.h"

namespace tessera::parquetry {

// Lays all pieces again, round after round, in the order of what they have lost so far against a place that they
// would have had as the first ones (squeaky wheel optimization, Joslin and Clements 1999); until `go_on` is false, or
// rounds do not gain any more. Keeps the best round: fewest pieces without wood, then least cost; what was given
// where none is better. Returns how many rounds were laid to their ends.
int lay_in_rounds(Workshop& workshop, std::vector<Laid>& pieces, const std::function<bool()>& go_on);

}  // namespace tessera::parquetry

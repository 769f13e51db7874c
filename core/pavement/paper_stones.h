// The polygon extraction of the paper to the letter (III.C), for comparison.
#pragma once

#include <vector>

#include "tessera/geometry/polygon.h"
#include "tessera/pavement/diagram.h"
#include "tessera/pavement/fields.h"
#include "tessera/pavement/params.h"

namespace tessera::pavement {

struct PaperStones {
  std::vector<Ring> rings;           // one a cell, pixels of the diagram
  std::vector<int> vertices_before;  // of each cell, before wide angles went
};

PaperStones paper_stones(const Diagram& diagram, const Fields& fields, const Params& params);

}  // namespace tessera::pavement

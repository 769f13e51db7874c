// Diagrams of drawings, as the steps after Lloyd's iterations get them.
#pragma once

#include "drawings.h"
#include "tessera/pavement/diagram.h"
#include "tessera/pavement/fields.h"
#include "tessera/pavement/sites.h"
#include "tessera/voronoi/cpu_rasterizer.h"

namespace tessera::pavement {

struct Prepared {
  Fields fields;
  Diagram diagram;
};

inline Prepared prepare(const cv::Mat3b& picture, const Params& params, std::uint64_t seed) {
  Prepared p{make_fields(view_of(picture), params), {}};
  const auto rasterizer = make_cpu_rasterizer();
  p.diagram = relax_diagram(first_sites(p.fields, params, seed), p.fields, params, seed, *rasterizer, {}, {}).value();
  return p;
}

}  // namespace tessera::pavement

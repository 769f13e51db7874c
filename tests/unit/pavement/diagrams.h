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
  Relaxed relaxed = relax_sites(first_sites(p.fields, params, seed), p.fields, noise_of(p.fields, params, seed), params,
                                *rasterizer, {}, {})
                        .value();
  p.diagram = diagram_of(std::move(relaxed.sites), std::move(relaxed.labels), p.fields);
  return p;
}

}  // namespace tessera::pavement

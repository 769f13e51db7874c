#include "tessera/job/techniques.h"

#include <algorithm>
#include <cassert>

#include "tessera/job/mosaic_job.h"
#include "tessera/job/pavement_job.h"

namespace tessera {

const std::vector<Technique>& techniques() {
  static const std::vector<Technique> all = {
      {.name = "pavement",
       .command = "pave",
       .help = "Portuguese pavement from a black-and-white (or coloured) drawing",
       .inputs = {{"drawing", "The drawing to pave"}},
       .formats = {"svg", "dxf", "png", "json", "csv", "apng"},
       .defaults = pavement::Params{},
       .run = run_pavement_job},
      {.name = "mosaic",
       .command = "mosaic",
       .help = "Decorative mosaic of oriented tiles from a photo",
       .inputs = {{"photo", "The photo to lay"},
                  {"edges", "Lines that rows of tiles follow, instead of the photo's own edges", false},
                  {"direction", "Directions of the tiles: grey 0 to 255 is an angle of 0 to 180 degrees", false},
                  {"regions", "Sizes of the tiles: its colours stand for those of --region-sizes", false}},
       .formats = {"svg", "dxf", "png", "json", "csv", "bom.csv", "apng"},
       .defaults = mosaic::Params{},
       .run = run_mosaic_job},
  };
  assert(all.size() == std::variant_size_v<TechniqueParams>);
  return all;
}

const Technique& technique_of(const TechniqueParams& params) { return techniques()[params.index()]; }

const Technique* find_technique(std::string_view name) {
  const auto& all = techniques();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Technique& t) { return t.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace tessera

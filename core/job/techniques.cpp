#include "tessera/job/techniques.h"

#include <algorithm>
#include <cassert>

#include "tessera/job/mosaic_job.h"
#include "tessera/job/pattern_job.h"
#include "tessera/job/pavement_job.h"
#include "tessera/job/pebbles_job.h"

namespace tessera {

const std::vector<Technique>& techniques() {
  static const std::vector<Technique> all = {
      {.name = "pavement",
       .command = "pave",
       .help = "Portuguese pavement from a black-and-white (or coloured) drawing",
       .inputs = {{"drawing", "The drawing to pave"}},
       .formats = {"svg", "dxf", "png", "json", "csv", "glb", "gltf", "apng"},
       .defaults = pavement::Params{},
       .run = run_pavement_job},
      {.name = "mosaic",
       .command = "mosaic",
       .help = "Decorative mosaic of oriented tiles from a photo",
       .inputs = {{"photo", "The photo to lay"},
                  {"edges", "Lines that rows of tiles follow, instead of the photo's own edges", false},
                  {"direction", "Directions of the tiles: grey 0 to 255 is an angle of 0 to 180 degrees", false},
                  {"regions", "Sizes of the tiles: its colours stand for those of --region-sizes", false}},
       .formats = {"svg", "dxf", "png", "json", "csv", "bom.csv", "glb", "gltf", "apng"},
       .defaults = mosaic::Params{},
       .run = run_mosaic_job},
      {.name = "pebbles",
       .command = "pebbles",
       .help = "Field of textured 3D stones from a photo of pebbles, taken from above",
       .inputs = {{"photo", "The photo of pebbles"},
                  {.name = "segmentation",
                   .help =
                       "Which pixels belong together, made elsewhere: a number or colour a pebble, black is ground",
                   .required = false,
                   .parameter = "segmenter",
                   .chosen = "labels",
                   .numbers = true}},
       .formats = {"glb", "gltf", "svg", "dxf", "png", "json", "csv", "labels.png", "overlay.png"},
       .defaults = pebbles::Params{},
       .run = run_pebbles_job},
      {.name = "pattern",
       .command = "pattern",
       .help = "Random pattern of a model: cells, bombs or points",
       .inputs = {{.name = "density",
                   .help = "Where the cox process has many points: dark for many",
                   .required = false,
                   .parameter = "process",
                   .chosen = "cox"}},
       .formats = {"svg", "dxf", "png", "json", "csv", "bom.csv", "glb", "gltf"},
       .defaults = patterns::Params{},
       .subject = "model",
       .run = run_pattern_job},
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

ImageView picture_of(const Pictures& pictures, std::string_view role) {
  const auto found = pictures.find(std::string(role));
  return found == pictures.end() ? ImageView{} : found->second;
}

}  // namespace tessera

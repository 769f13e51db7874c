#include "tessera/job/techniques.h"

#include <algorithm>
#include <cassert>

#include "tessera/job/mosaic_job.h"
#include "tessera/job/parameters.h"
#include "tessera/job/parquet_job.h"
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
      {.name = "parquetry",
       .command = "parquet",
       .help = "Cut files of a picture made of real wood",
       .inputs = {{"target", "The picture to make, or several from the same wood"},
                  {.name = "target", .help = "More pictures of the same wood", .required = false, .many = true},
                  {.name = "segmentation",
                   .help = "The pieces' shapes: a colour or number each, or an SVG of closed paths",
                   .required = false,
                   .numbers = true,
                   .shapes = true},
                  {.name = "edge-mask",
                   .help = "Where --grid morphed follows edges: white all, red large, blue fine ones, black none",
                   .required = false},
                  {.name = "panel", .help = "Scans of veneer", .many = true},
                  {.name = "mask", .help = "White where a panel is wood", .required = false, .many = true}},
       .formats = {"folder", "svg", "dxf", "png", "json", "csv"},
       .defaults = parquetry::Params{},
       .questions = parquet_questions(),
       .long_running = true,
       .run = run_parquet_job},
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

const InputRole* role_of(const Technique& technique, std::string_view input) {
  for (const InputRole& role : technique.inputs)
    if (role.many ? !name_in(role, input).empty() : role.name == input) return &role;
  return nullptr;
}

std::string role_names(const Technique& technique) {
  std::vector<std::string> names;
  for (const InputRole& role : technique.inputs) names.push_back(std::string(role.name) + (role.many ? "-NAME" : ""));
  return either_of(names);
}

std::string_view name_in(const InputRole& role, std::string_view input) {
  const std::size_t dash = role.name.size();
  if (input.substr(0, dash) != role.name || input.substr(dash, 1) != "-") return {};
  const std::string_view name = input.substr(dash + 1);
  return parquetry::is_panel_name(name) ? name : std::string_view();
}

ImageView picture_of(const Pictures& pictures, std::string_view role) {
  const auto found = pictures.find(std::string(role));
  return found == pictures.end() ? ImageView{} : found->second;
}

}  // namespace tessera

// A job: the reproducible unit of work, and the only entry into the techniques.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/run_context.h"
#include "tessera/formats/formats.h"
#include "tessera/geometry/piece.h"
#include "tessera/geometry/raster.h"
#include "tessera/geometry/scene.h"
#include "tessera/image/image_view.h"
#include "tessera/mosaic/params.h"
#include "tessera/parquetry/params.h"
#include "tessera/patterns/params.h"
#include "tessera/pavement/params.h"
#include "tessera/pebbles/params.h"
#include "tessera/voronoi/lloyd.h"

namespace tessera {

inline constexpr int kSchemaVersion = 1;
// The largest whole number that JSON carries unharmed everywhere, JavaScript included.
inline constexpr std::uint64_t kMaxSeed = (std::uint64_t{1} << 53) - 1;

// One alternative a technique. A new technique adds its struct here and a row to techniques() (techniques.h).
using TechniqueParams =
    std::variant<pavement::Params, mosaic::Params, pebbles::Params, patterns::Params, parquetry::Params>;

struct Job {
  std::uint64_t seed = 1;  // 0 to kMaxSeed
  TechniqueParams params;
  std::map<std::string, std::string> inputs;  // role ("drawing") -> path or name; the core never opens it
};

// Decoded pictures, one a role; valid during the call they are handed to.
using Pictures = std::map<std::string, ImageView>;

// A finished output in memory. `name` is the extension it answers ("svg") or a file name ("plots/vertices.svg",
// "folder/panel-oak.cut.svg").
struct Artifact {
  std::string name;
  std::string media_type;
  std::string bytes;
};

inline constexpr double kMaxPngScale = 16;

struct JobRequest {
  std::vector<std::string> formats;  // of those the technique has: "svg", "dxf"; others are kInvalidParameter
  bool plots = false;
  double png_scale = 0;  // output pixels a source pixel, up to kMaxPngScale; 0 lets the sheet's size decide
};

// A figure of the paper, drawn from a run.
struct Plot {
  std::string name;  // "vertices"
  std::variant<Histogram, Curves> figure;
};

std::string write_plot(const Plot& plot);  // as SVG

// What a technique has made, before it is bytes, in terms that all of them share.
struct Outcome {
  PieceSheet sheet;  // with the job in it
  Scene scene{};     // with the job in it; of techniques whose pieces are solid
  std::map<std::string, std::function<Raster()>> rasters{};  // pictures besides the sheet's, by format ("labels.png")
  std::function<std::vector<Artifact>()> folder{};           // what "folder" and "zip" hold, by the files' names
  std::function<void(Raster&)> finish{};       // of the sheet's picture, where that is more than its pieces
  std::map<std::string, std::int64_t> counts;  // of the report
  std::map<std::string, double> metrics;       // finite
  std::vector<Plot> plots;
  std::string state{};        // for RunContext::earlier of a job that differs only in what comes after the long part
  std::optional<Job> done{};  // makes the same again, where the job that was run may not
  Frames frames = {};         // of the iterations, where they were recorded
};

struct JobResult {
  std::vector<Artifact> artifacts;             // in the order of request.formats, of "folder" many; then plots
  std::map<std::string, std::int64_t> counts;  // of the report
  std::map<std::string, double> metrics;       // finite
  Job job;                                     // makes the same again
};

// Runs the job on decoded pictures: compute_job(), then write_artifacts(); "apng" shows its iterations. Reports all
// problems of parameters, inputs and formats together. OpenCV's exceptions and failed allocations end here, as
// kInternal. Stages are the technique's, then "format".
tl::expected<JobResult, Problems> run_job(const Job& job, const Pictures& pictures, const JobRequest& request,
                                          Rasterizer& rasterizer, const RunContext& context,
                                          const IterationObserver& observer = {});

// The two halves of run_job(), for a program that wants files of a result later, one by one. Errors as there; the
// second reports stage "format" and its own progress, 0..1. `records` keeps iterations for "apng", of techniques that
// have it; where it does not, "apng" is the result alone.
tl::expected<Outcome, Problems> compute_job(const Job& job, const Pictures& pictures, Rasterizer& rasterizer,
                                            const RunContext& context, const IterationObserver& observer = {},
                                            bool records = false);
tl::expected<std::vector<Artifact>, Problems> write_artifacts(const Job& job, const Outcome& outcome,
                                                              const JobRequest& request, const RunContext& context);
// The picture that a result's PNG holds; `png_scale` as in JobRequest.
Raster draw_picture(const Outcome& outcome, double png_scale = 0);

}  // namespace tessera

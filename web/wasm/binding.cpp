// What JavaScript sees: functions over texts, numbers and byte arrays. Jobs and answers travel as JSON, bytes are
// copied, and no C++ object leaves. web/package/src/index.ts wraps these into the interface that programs use.
#include <emscripten/bind.h>
#include <fmt/format.h>

#include <cmath>
#include <opencv2/core/utility.hpp>
#include <string>
#include <utility>
#include <variant>

#include "engine.h"
#include "tessera/base/colour.h"
#include "tessera/job/job_json.h"
#include "tessera/job/reference.h"
#include "tessera/job/shapes.h"
#include "tessera/job/techniques.h"
#include "tessera/voronoi/preview.h"

namespace tessera {
namespace {

using emscripten::val;

Engine& engine() {
  static Engine one;
  return one;
}

// Only during an observer's call.
const Iteration* current_iteration = nullptr;
const std::function<std::string()>* current_state = nullptr;

const char* name_of(StatusCode code) {
  switch (code) {
    case StatusCode::kInternal: return "internal";
    case StatusCode::kInvalidParameter: return "invalidParameter";
    case StatusCode::kInvalidInput: return "invalidInput";
    case StatusCode::kUnwritable: return "unwritable";
    case StatusCode::kTimeout: return "timeout";
    case StatusCode::kCancelled: return "cancelled";
  }
  return "internal";
}

std::string to_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json to_json(const Problems& problems) {
  Json list = Json::array();
  for (const Status& problem : problems) {
    list.push_back({{"code", name_of(problem.code)}, {"field", problem.field}, {"message", problem.message}});
  }
  return list;
}

// {"problems": [...]}: what is returned in the place of an answer.
std::string problems_text(const Problems& problems) { return to_text({{"problems", to_json(problems)}}); }

template <class Element>
val bytes_of(const Element* elements, std::size_t count) {
  return val(emscripten::typed_memory_view(count, elements)).template call<val>("slice");
}

std::string version() { return TESSERA_VERSION; }

std::string schema() { return to_text(job_schema()); }

std::string technique_list() {
  Json list = Json::array();
  for (const Technique& technique : techniques()) {
    Json inputs = Json::array();
    for (const InputRole& role : technique.inputs)
      inputs.push_back({{"name", role.name},
                        {"help", role.help},
                        {"required", role.required},
                        {"parameter", role.parameter},
                        {"chosen", role.chosen},
                        {"many", role.many}});
    Json questions = Json::array();
    for (const Question& question : technique.questions) questions.push_back(question.name);
    list.push_back({{"name", technique.name},
                    {"command", technique.command},
                    {"help", technique.help},
                    {"inputs", inputs},
                    {"subject", technique.subject},
                    {"questions", questions},
                    {"formats", technique.formats}});
  }
  return to_text(list);
}

// The whole job, every parameter in it, or problems.
std::string read(const std::string& text) {
  const auto job = read_job(text);
  return job ? to_text({{"job", job_to_json(*job)}}) : problems_text(job.error());
}

void set_threads(int threads) { cv::setNumThreads(threads); }

std::uintptr_t stop_address() { return reinterpret_cast<std::uintptr_t>(&engine().stop()); }

// Of a Uint8Array of straight alpha. kInvalidInput, in the name of `role`, for a size that cannot be.
Result<Input> picture_of(const std::string& role, const val& rgba, int width, int height) {
  constexpr double kMaxPixels = 1e8;
  if (width < 1 || height < 1 || static_cast<double>(width) * height > kMaxPixels)
    return fail(StatusCode::kInvalidInput, role,
                fmt::format("is {} x {} px, expected at least one pixel and at most {:.0f} Mpx", width, height,
                            kMaxPixels / 1e6));
  Input picture{cv::Mat3b(height, width), cv::Mat1b(height, width)};
  bool opaque = true;
  std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(width));
  const val target(emscripten::typed_memory_view(row.size(), row.data()));
  for (int y = 0; y < height; ++y) {
    const double begin = static_cast<double>(row.size()) * y;
    target.call<void>("set", rgba.call<val>("subarray", begin, begin + static_cast<double>(row.size())));
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* from = &row[4 * static_cast<std::size_t>(x)];
      for (int c = 0; c < 3; ++c) picture.rgb(y, x)[c] = over_white(from[c], from[3]);
      picture.alpha(y, x) = from[3];
      opaque = opaque && from[3] == 255;
    }
  }
  if (opaque) picture.alpha.release();
  return picture;
}

// Empty, or problems.
std::string set_input(const std::string& role, const val& rgba, int width, int height, double dpi) {
  auto picture = picture_of(role, rgba, width, height);
  if (!picture) return problems_text({picture.error()});
  picture->dpi = dpi;
  engine().set_picture(role, *std::move(picture));
  return "";
}

void forget_input(const std::string& role) { engine().forget_picture(role); }

// Empty, or why diagrams cannot be drawn with the context that is current.
std::string use_gl(bool software) {
  const auto usable = engine().use_gl(software);
  return usable ? "" : usable.error().message;
}

BackendChoice choice_of(const std::string& name) {
  if (name == "cpu") return BackendChoice::kCpu;
  return name == "gl" ? BackendChoice::kGl : BackendChoice::kAuto;
}

// `watcher` has the functions stage(name), progress(fraction), warning(message), iteration(index, last), state().
RunContext context_for(const val& watcher) {
  RunContext context;
  context.on_stage = [watcher](std::string_view name) { watcher.call<void>("stage", std::string(name)); };
  context.on_progress = [watcher](double fraction) { watcher.call<void>("progress", fraction); };
  context.on_warning = [watcher](std::string_view text) { watcher.call<void>("warning", std::string(text)); };
  return context;
}

// `improves`: watcher.goOn() says whether to go on making the result better, as often as that is asked.
std::string run(const std::string& job_text, const std::string& backend_choice, bool improves, const val& watcher) {
  const auto job = read_job(job_text);
  if (!job) return problems_text(job.error());
  RunContext context = context_for(watcher);
  context.on_state = [&](const std::function<std::string()>& state) {
    current_state = &state;
    watcher.call<void>("state");
    current_state = nullptr;
  };
  if (improves) context.go_on_improving = [watcher] { return watcher.call<bool>("goOn"); };
  const auto observer = [&](const Iteration& iteration) {
    current_iteration = &iteration;
    watcher.call<void>("iteration", iteration.index, iteration.last);
    current_iteration = nullptr;
  };
  std::string backend;
  const auto outcome = engine().run(*job, choice_of(backend_choice), context, observer, backend);
  if (!outcome) return problems_text(outcome.error());
  return to_text({{"backend", backend},
                  {"counts", (*outcome)->counts},
                  {"metrics", (*outcome)->metrics},
                  {"job", job_to_json((*outcome)->done.value_or(*job))},
                  {"retouched", static_cast<bool>((*outcome)->finish)}});
}

// The diagram of the iteration that is being observed; null at any other time.
val preview(int max_pixels, int max_sites) {
  if (!current_iteration) return val::null();
  const Preview preview = make_preview(*current_iteration, max_pixels, max_sites);
  const auto& palette = current_iteration->palette;
  val object = val::object();
  object.set("width", preview.cells.cols);
  object.set("height", preview.cells.rows);
  object.set("cells", bytes_of(preview.cells.ptr(), preview.cells.total()));
  object.set("palette", bytes_of(&palette.data()->r, sizeof(Rgb) * palette.size()));
  object.set("sites", bytes_of(preview.sites.data(), preview.sites.size()));
  return object;
}

// What has been made so far, of a technique that runs for long; null at any other time than during watcher.state().
val state() { return current_state ? val((*current_state)()) : val::null(); }

val to_val(const Artifact& made) {
  val object = val::object();
  object.set("name", made.name);
  object.set("mediaType", made.media_type);
  object.set("bytes", bytes_of(reinterpret_cast<const std::uint8_t*>(made.bytes.data()), made.bytes.size()));
  return object;
}

// {name, mediaType, bytes}, or problems as text.
val artifact(const std::string& format) {
  const auto made = engine().artifact(format);
  return made ? to_val(*made) : val(problems_text(made.error()));
}

// A list of these.
val artifacts(const std::string& format) {
  const auto made = engine().artifacts(format);
  if (!made) return val(problems_text(made.error()));
  val list = val::array();
  for (const Artifact& each : *made) list.call<void>("push", to_val(each));
  return list;
}

// {"answer": text}, or problems.
std::string ask(const std::string& question, const std::string& job_text, const val& watcher) {
  const auto job = read_job(job_text);
  if (!job) return problems_text(job.error());
  const auto answer = engine().ask(question, *job, context_for(watcher));
  return answer ? to_text({{"answer", *answer}}) : problems_text(answer.error());
}

// ---- Pieces' shapes

// {width, height, data} with opaque pixels, of an SVG of closed shapes; or problems as text.
val paint_shapes(const std::string& svg) {
  constexpr std::uint64_t kMaxPixels = 100'000'000;
  const auto raster = read_shapes(svg, kMaxPixels);
  if (!raster) return val(problems_text({raster.error()}));
  std::vector<std::uint8_t> rgba;
  rgba.reserve(raster->bytes.size() / 3 * 4);
  for (std::size_t i = 0; i < raster->bytes.size(); i += 3) {
    rgba.insert(rgba.end(), &raster->bytes[i], &raster->bytes[i] + 3);
    rgba.push_back(255);
  }
  val object = val::object();
  object.set("width", raster->width);
  object.set("height", raster->height);
  object.set("data", bytes_of(rgba.data(), rgba.size()));
  return object;
}

// Its size, or problems.
std::string begin_grid(const std::string& job_text) {
  const auto job = read_job(job_text);
  if (!job) return problems_text(job.error());
  const auto grid = engine().begin_grid(*job);
  if (!grid) return problems_text(grid.error());
  const double mm = (*grid)->mm_per_px();
  return to_text({{"across", (*grid)->grid().across()},
                  {"down", (*grid)->grid().down()},
                  {"widthMm", mm * (*grid)->size().width},
                  {"heightMm", mm * (*grid)->size().height}});
}

// All vertices, row by row: x and y, mm. Null before a grid has begun.
val grid_vertices() {
  const parquetry::LiveGrid* live = engine().live_grid();
  if (!live) return val::null();
  std::vector<double> places;
  for (int row = 0; row <= live->grid().down(); ++row)
    for (int column = 0; column <= live->grid().across(); ++column) {
      const Point mm = live->mm_per_px() * live->grid().vertex(column, row);
      places.insert(places.end(), {mm.x, mm.y});
    }
  return bytes_of(places.data(), places.size());
}

// {width, height, found, counting}: all edges, and those that masks leave; a byte a pixel, 1 on a large edge, 2 on a
// fine one, 3 on both.
val grid_edges() {
  const parquetry::LiveGrid* live = engine().live_grid();
  if (!live) return val::null();
  const auto kinds_of = [](const parquetry::FoundEdges& edges) {
    const cv::Mat1b kinds = (edges.rolling_guidance & 1) | (edges.bilateral & 2);
    return bytes_of(kinds.ptr(), kinds.total());
  };
  val object = val::object();
  object.set("width", live->found().bilateral.cols);
  object.set("height", live->found().bilateral.rows);
  object.set("found", kinds_of(live->found()));
  object.set("counting", kinds_of(live->counting()));
  return object;
}

int step_grid(int most) { return engine().live_grid() ? engine().live_grid()->step(most) : 0; }

void drag_vertex(int column, int row, double x, double y) {
  parquetry::LiveGrid* live = engine().live_grid();
  const auto is_within = [](int k, int last) { return k >= 0 && k <= last; };
  if (live && is_within(column, live->grid().across()) && is_within(row, live->grid().down()) && std::isfinite(x) &&
      std::isfinite(y))
    live->drag(column, row, {x, y});
}

std::string lay_vertex() { return engine().live_grid() ? engine().live_grid()->lay() : std::string(); }

// ---- Statistics

Json points_json(const std::vector<Point>& points) {
  Json list = Json::array();
  for (const Point p : points) list.push_back({p.x, p.y});
  return list;
}

// Curves have points, histograms values over bins.
Json to_json(const Plot& plot) {
  Json json = {{"name", plot.name}, {"svg", write_plot(plot)}, {"series", Json::array()}};
  std::visit(
      [&](const auto& figure) {
        json["title"] = figure.title;
        json["xLabel"] = figure.x_label;
        json["yLabel"] = figure.y_label;
      },
      plot.figure);
  if (const auto* curves = std::get_if<Curves>(&plot.figure)) {
    for (const auto& series : curves->series)
      json["series"].push_back({{"name", series.name}, {"points", points_json(series.points)}});
  } else {
    const auto& histogram = std::get<Histogram>(plot.figure);
    json["bins"] = histogram.bins;
    for (const auto& series : histogram.series)
      json["series"].push_back({{"name", series.name}, {"values", series.values}});
  }
  return json;
}

// What `measure` makes of the options, or problems.
template <class Measure>
std::string measured_text(const std::string& options_text, const Measure& measure) {
  const auto options = read_measure_options(Json::parse(options_text));
  if (!options) return problems_text(options.error());
  const auto measured = measure(*options);
  if (!measured) return problems_text(measured.error());
  Json plots = Json::array();
  for (const Plot& plot : measured->plots) plots.push_back(to_json(plot));
  return to_text({{"report", measured->json}, {"csv", measured->csv}, {"plots", plots}});
}

// `bytes` is a Uint8Array with a file of cells or points; `options` as read_measure_options() has them.
std::string measure_file(const val& bytes, const std::string& options, const val& watcher) {
  const std::string file = bytes.as<std::string>();
  return measured_text(options,
                       [&](const MeasureOptions& o) { return engine().measure(file, o, context_for(watcher)); });
}

std::string measure_pixels(const val& rgba, int width, int height, const std::string& options, const val& watcher) {
  const auto picture = picture_of("", rgba, width, height);
  if (!picture) return problems_text({picture.error()});
  return measured_text(
      options, [&](const MeasureOptions& o) { return engine().measure(picture->rgb, o, context_for(watcher)); });
}

std::string fit(const val& rgba, int width, int height, double seed, const val& watcher) {
  if (!(seed >= 0 && seed <= static_cast<double>(kMaxSeed)))
    return problems_text(
        {{StatusCode::kInvalidParameter, "seed", fmt::format("is {}, expected 0 to {}", seed, kMaxSeed)}});
  const auto picture = picture_of("", rgba, width, height);
  if (!picture) return problems_text({picture.error()});
  const auto whole_seed = static_cast<std::uint64_t>(seed);
  const auto found = engine().fit(picture->rgb, whole_seed, context_for(watcher));
  return found ? to_text(fit_to_json(*found, whole_seed)) : problems_text(found.error());
}

}  // namespace
}  // namespace tessera

EMSCRIPTEN_BINDINGS(tessera) {
  emscripten::function("version", &tessera::version);
  emscripten::function("schema", &tessera::schema);
  emscripten::function("techniques", &tessera::technique_list);
  emscripten::function("read", &tessera::read);
  emscripten::function("setThreads", &tessera::set_threads);
  emscripten::function("stopAddress", &tessera::stop_address);
  emscripten::function("setInput", &tessera::set_input);
  emscripten::function("forgetInput", &tessera::forget_input);
  emscripten::function("useGl", &tessera::use_gl);
  emscripten::function("run", &tessera::run);
  emscripten::function("preview", &tessera::preview);
  emscripten::function("state", &tessera::state);
  emscripten::function("artifact", &tessera::artifact);
  emscripten::function("artifacts", &tessera::artifacts);
  emscripten::function("ask", &tessera::ask);
  emscripten::function("paintShapes", &tessera::paint_shapes);
  emscripten::function("beginGrid", &tessera::begin_grid);
  emscripten::function("gridVertices", &tessera::grid_vertices);
  emscripten::function("gridEdges", &tessera::grid_edges);
  emscripten::function("stepGrid", &tessera::step_grid);
  emscripten::function("dragVertex", &tessera::drag_vertex);
  emscripten::function("layVertex", &tessera::lay_vertex);
  emscripten::function("measureFile", &tessera::measure_file);
  emscripten::function("measurePixels", &tessera::measure_pixels);
  emscripten::function("fit", &tessera::fit);
}

#include "tessera/cli/view_command.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <thread>
#include <utility>
#include <variant>

#include "tessera/cli/backend.h"
#include "tessera/cli/inputs.h"
#include "tessera/cli/messages.h"
#include "tessera/cli/run_command.h"
#include "tessera/cli/saved_job.h"
#include "tessera/cli/signals.h"
#include "tessera/geometry/extrude.h"
#include "tessera/io/atomic_file.h"
#include "tessera/io/file.h"
#include "tessera/io/picture.h"
#include "tessera/job/recorder.h"
#include "tessera/view/feed.h"
#include "tessera/view/read_gltf.h"
#include "tessera/view/window.h"

namespace tessera {
namespace {

constexpr const char* kPreviewFile = "preview.png";  // of a parquetry's folder
constexpr const char* kScreenshot = "tessera-view.png";

// ---- What a file holds

using Opened = std::variant<Job, view::Content>;

tl::unexpected<Problems> problem(Status status) { return tl::unexpected<Problems>(Problems{std::move(status)}); }

view::Content flat_content(Raster raster, view::Size size) {
  return {std::make_shared<const view::Flat>(view::Flat{std::move(raster), size}), {}};
}

Result<view::Content> picture_content(const std::string& bytes, std::uint64_t max_pixels) {
  const auto picture =
      decode_picture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, max_pixels);
  if (!picture) return tl::unexpected<Status>(picture.error());
  Raster raster{picture->width, picture->height, 3, 8, {}};
  raster.bytes.assign(picture->rgb.get(),
                      picture->rgb.get() + 3 * static_cast<std::size_t>(raster.width) * raster.height);
  return flat_content(std::move(raster), {0.0 + picture->width, 0.0 + picture->height});
}

Result<view::Content> solid_content(const std::string& bytes) {
  auto scene = view::read_gltf(bytes);
  if (!scene) return tl::unexpected<Status>(std::move(scene.error()));
  return view::Content{{}, [kept = std::make_shared<const Scene>(*std::move(scene))] { return kept; }};
}

bool looks_like_job(const std::string& bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return first != std::string::npos && (bytes[first] == '{' || bytes[first] == '<');
}

tl::expected<Opened, Problems> open_file(const View& view) {
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(view.path, error);
  const std::string path = is_folder ? (std::filesystem::path(view.path) / kPreviewFile).string() : view.path;
  if (is_folder && !std::filesystem::exists(path, error))
    return problem(
        {StatusCode::kInvalidInput, view.path, "holds no preview.png, expected a folder of tessera parquet"});
  auto bytes = read_file(path);
  if (!bytes) return problem(std::move(bytes.error()));
  const bool is_gltf = view::looks_like_gltf(*bytes);
  if (!is_gltf && looks_like_job(*bytes)) return read_saved_job(*bytes, path, view.changes);
  if (!view.changes.empty())
    return problem({StatusCode::kInvalidParameter, "--set", "is for jobs, which " + input_name(path) + " is not"});
  auto content = is_gltf ? solid_content(*bytes) : picture_content(*bytes, view.settings.max_pixels);
  if (!content) return problem({content.error().code, input_name(path), content.error().message});
  return *std::move(content);
}

// ---- A job's run, watched

// The diagram in the picture's colours, as an animation of the iterations has it.
view::Content content_of(const Iteration& iteration, const ImageView& source) {
  return flat_content(Recorder::draw(source, iteration), {0.0 + source.width, 0.0 + source.height});
}

view::Content content_of(Outcome outcome) {
  const view::Size size{outcome.sheet.width, outcome.sheet.height};
  const bool solid_first = !outcome.scene.views.empty();
  const bool is_picture = static_cast<bool>(outcome.finish);
  const auto made = std::make_shared<Outcome>(std::move(outcome));
  const auto flat = is_picture ? std::make_shared<const view::Flat>(view::Flat{draw_picture(*made), size})
                               : std::make_shared<const view::Flat>(view::Flat{made->sheet, size});
  const auto solid = [made, solid_first] {
    return solid_first ? std::shared_ptr<const Scene>(made, &made->scene)
                       : std::make_shared<const Scene>(extruded(made->sheet));
  };
  return {flat, solid, solid_first};
}

// Runs a job on a thread of its own and feeds what comes of it.
class JobThread {
 public:
  JobThread(Job job, std::string folder, const Settings& settings, view::Feed& feed)
      : settings_(settings), feed_(feed), thread_([this, job = std::move(job), folder = std::move(folder)] {
          const bool done = run(job, folder);
          feed_.end(done);
        }) {}
  ~JobThread() { finish(); }
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;

  // Stops it, if it still runs. The problems it had before; empty: none.
  const Problems& finish() {
    if (thread_.joinable()) {
      stop_ = static_cast<int>(StopReason::kCancelled);
      thread_.join();
    }
    return problems_;
  }

 private:
  bool run(const Job& job, const std::string& folder) {
    feed_.stage("decode");
    const auto inputs = read_inputs(job, folder, settings_.max_pixels, false);
    if (!inputs) return end_with(inputs.error());
    auto backend = make_backend(settings_.backend);
    if (!backend) return end_with({backend.error()});
    const auto warn = [this](std::string_view message) {
      if (!settings_.quiet) print_message("warning: " + std::string(message));
    };
    if (settings_.backend == BackendChoice::kAuto && backend->context) let_cpu_take_over(*backend, warn);
    RunContext context;
    context.stop = &stop_;
    context.on_stage = [this](std::string_view stage) { feed_.stage(stage); };
    context.on_progress = [this](double fraction) { feed_.progress(fraction); };
    context.on_warning = warn;
    Pictures pictures;
    for (const auto& [role, input] : *inputs) pictures[role] = input.picture.view();
    IterationObserver observer;
    if (const auto& roles = technique_of(job.params).inputs;
        !roles.empty() && pictures.count(std::string(roles[0].name)))
      observer = [this, source = pictures.at(std::string(roles[0].name))](const Iteration& iteration) {
        if (feed_.is_awaited()) feed_.show(content_of(iteration, source));
      };
    auto outcome = compute_job(job, pictures, *backend->rasterizer, context, observer);
    if (!outcome) return end_with(outcome.error());
    feed_.show(content_of(*std::move(outcome)));
    return true;
  }

  bool end_with(const Problems& problems) {
    if (stop_ == static_cast<int>(StopReason::kNone)) problems_ = problems;  // else it is us who ended it
    return false;
  }

  const Settings& settings_;
  view::Feed& feed_;
  std::atomic<int> stop_{static_cast<int>(StopReason::kNone)};
  Problems problems_;
  std::thread thread_;  // the last member: it uses the others
};

// ---- The window

Result<void> save_picture(const std::string& path, const Raster& picture) {
  AtomicFiles files;
  return files.add(path, write_png(picture)).and_then([&] { return files.commit(); });
}

void say(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) print_message(line);
}

view::WindowOptions window_options(const View& view) {
  view::WindowOptions options;
  options.title = input_name(view.path) + " - tessera";
  options.width = view.size[0];
  options.height = view.size[1];
  options.ends = view.ends;
  options.stop = &stop_flag();
  options.say = say;
  options.save = [&view](const Raster& picture) -> Result<void> {
    if (view.ends && view.screenshot.empty()) return {};
    const std::string path = view.screenshot.empty() ? std::string(kScreenshot) : view.screenshot;
    auto saved = save_picture(path, picture);
    if (saved && !view.ends) say("saved " + path);
    return saved;
  };
  return options;
}

}  // namespace

ViewFlags::ViewFlags(CLI::App& app)
    : app_(*app.add_subcommand("view", "Show a result or a picture in a window; run a job and watch it")),
      settings_(app_, "Run", [] {
        std::vector<Parameter> flags = setting_flags();
        std::erase_if(flags, [](const Parameter& flag) {
          return std::string(flag.info.key) == "progress" || std::string(flag.info.key) == "pngScale";
        });
        return flags;
      }()) {
  app_.add_option("FILE", view_.path,
                  "A picture, a GLB or glTF, a job's JSON, an SVG that tessera made, or the folder of a parquetry")
      ->required()
      ->type_name("FILE");
  app_.add_option("--set", view_.changes, "Change a parameter, an input or the seed of a job")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all();
  app_.add_option("--size", view_.size, "Width and height of the window; default 1280 800")
      ->expected(2)
      ->check(CLI::Range(64, 8192))
      ->type_name("W H");
  app_.add_option("--screenshot", view_.screenshot,
                  std::string("Where the key s saves what is seen; default ") + kScreenshot)
      ->type_name("FILE");
  app_.add_flag("--exit", view_.ends, "End once the result has been shown; the screenshot is saved, if one is named");
  app_.add_flag("--quiet", view_.settings.quiet, "No warnings")->group("Run");
  app_.footer("Keys:\n" + view::key_help());
}

View ViewFlags::read(Problems& problems) const {
  View view = view_;
  read_settings(settings_.given(), view.settings, problems);
  settings_.name_flags(problems);
  return view;
}

int run_view(const View& view) {
  prepare(view.settings);
  auto opened = open_file(view);
  if (!opened) return print_problems(stop_reason() == StopReason::kNone ? opened.error() : Problems{stop_status()});
  auto window = view::Window::open(window_options(view));
  if (!window) return print_problems({std::move(window.error())});
  view::Feed feed;
  std::optional<JobThread> thread;
  if (Job* job = std::get_if<Job>(&*opened)) {
    if (view.settings.seed) job->seed = *view.settings.seed;
    thread.emplace(std::move(*job), std::filesystem::path(view.path).parent_path().string(), view.settings, feed);
  } else {
    feed.show(std::get<view::Content>(*std::move(opened)));
    feed.end(true);
  }
  const auto shown = window->run(feed);
  const Problems problems = thread ? thread->finish() : Problems{};
  if (stop_reason() != StopReason::kNone) return print_problems({stop_status()});
  if (!problems.empty()) return print_problems(problems);
  return shown ? kExitDone : print_problems({shown.error()});
}

}  // namespace tessera

#include "tessera/cli/measure_command.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "tessera/cli/messages.h"
#include "tessera/cli/signals.h"
#include "tessera/io/atomic_file.h"
#include "tessera/io/file.h"
#include "tessera/io/picture.h"
#include "tessera/io/sha256.h"
#include "tessera/job/measure.h"

namespace tessera {
namespace {

constexpr std::uint64_t kMaxPixels = 100'000'000;

tl::expected<MeasureOptions, Problems> options_of(const Measure& m) {
  Json json = {{"distances", m.distances}, {"needles", m.needles}, {"colors", m.colors}, {"seed", m.seed}};
  if (!m.model.empty()) json.update({{"model", m.model}, {"lambda", m.lambda}});
  if (!m.window.empty()) json["window"] = m.window;
  return read_measure_options(json);
}

void check_outputs(const Measure& m, Problems& problems) {
  for (const std::string& path : m.outputs) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (path != "-" && extension != ".json" && extension != ".csv")
      problems.push_back({StatusCode::kInvalidParameter, path, "is neither .json nor .csv"});
  }
}

bool looks_like_text(const std::string& bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string::npos) return true;
  const auto is_text = [](unsigned char c) { return c >= 0x20 || c == '\n' || c == '\r' || c == '\t'; };
  return std::all_of(bytes.begin(),
                     bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 64)), is_text) &&
         bytes.compare(0, 2, "BM") != 0 && bytes.compare(0, 4, "RIFF") != 0;
}

Result<Measured> measure_bytes(const std::string& bytes, const MeasureOptions& options, std::uint64_t max_pixels) {
  RunContext context;
  context.stop = &stop_flag();
  if (looks_like_text(bytes)) {
    auto file = read_pattern_file(bytes);
    if (!file) return tl::unexpected<Status>(std::move(file.error()));
    return measure_pattern(*file, options, context);
  }
  auto picture = decode_picture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                                max_pixels > 0 ? max_pixels : kMaxPixels);
  if (!picture) return tl::unexpected<Status>(std::move(picture.error()));
  return measure_picture(picture->view(), options, context);
}

std::string report_of(const Measure& m, const std::string& bytes, const Json& json) {
  Json report = {{"tessera", TESSERA_VERSION},
                 {"technique", "measure"},
                 {"seed", m.seed},
                 {"inputs", {{{"path", m.path}, {"sha256", sha256_hex(bytes)}}}}};
  report.update(json);
  return report.dump(1) + "\n";
}

Result<void> write(const Measure& m, const std::string& bytes, const Measured& measured) {
  const std::string report = report_of(m, bytes, measured.json);
  AtomicFiles files;
  const auto add = [&](const std::string& path, std::string_view content) { return files.add(path, content); };
  const bool nowhere = m.outputs.empty() && m.report.empty() && m.plots.empty();
  if (nowhere)
    if (auto done = add("-", report); !done) return done;
  for (const std::string& path : m.outputs) {
    const bool is_csv = std::filesystem::path(path).extension() == ".csv";
    if (auto done = add(path, is_csv ? measured.csv : report); !done) return done;
  }
  if (!m.report.empty())
    if (auto done = add(m.report, report); !done) return done;
  if (!m.plots.empty())
    if (auto done = files.add_folder(m.plots); !done) return done;
  for (const Plot& plot : measured.plots) {
    if (m.plots.empty()) break;
    if (auto done = add((std::filesystem::path(m.plots) / (plot.name + ".svg")).string(), write_plot(plot)); !done)
      return done;
  }
  if (stop_reason() != StopReason::kNone) return tl::unexpected<Status>(stop_status());
  return files.commit();
}

}  // namespace

CLI::App& add_measure_command(CLI::App& app, Measure& m) {
  CLI::App& command = *app.add_subcommand("measure", "Statistics of a picture, of a pattern's cells or of points");
  command
      .add_option(
          "FILE", m.path,
          "A picture, GeoJSON of polygons or points, a JSON list or CSV of points, or an SVG that tessera made")
      ->required()
      ->type_name("FILE");
  std::vector<std::string> names;
  for (const auto& model : statistics::cell_models()) names.emplace_back(model.name);
  const std::string compare = "Compare";
  command.add_option("--model", m.model, "The model whose closed forms stand beside: " + either_of(names))
      ->type_name("NAME")
      ->group(compare);
  command
      .add_option("--lambda", m.lambda,
                  "Its number: lines a pixel and radian, points an area, Johnson-Mehl rate / speed, or a cell's side")
      ->type_name("X")
      ->group(compare);
  command
      .add_option("--distances", m.distances, "Lengths of needles, radii of K; 24 that suit the size if not given")
      ->type_name("X...");
  command.add_option("--needles", m.needles, "Needles thrown for each length; default 40000")->type_name("N");
  command.add_option("--colors", m.colors, "Colours of a picture; default 0, as many as it has")->type_name("N");
  command.add_option("--window", m.window, "Width and height of the window; what the file says if not given")
      ->expected(2)
      ->type_name("W H");
  command.add_option("--seed", m.seed, "Start of the random numbers; default 1")->type_name("N");
  command.add_option("--max-pixels", m.max_pixels, "Larger pictures are refused; default 100000000")->type_name("N");
  command.add_option("-o,--output", m.outputs, "Where the statistics go: .json or .csv; several are allowed")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->take_all();
  command.add_option("--report", m.report, "The same as -o FILE.json")->type_name("FILE");
  command.add_option("--plots", m.plots, "Write the curves as SVG, closed forms beside them")->type_name("FOLDER");
  command.footer("Without an output the statistics go to standard output, as JSON.");
  return command;
}

int run_measure(const Measure& m) {
  Problems problems;
  const auto options = options_of(m);
  if (!options) problems = options.error();
  check_outputs(m, problems);
  if (!problems.empty()) return print_problems(problems);
  auto bytes = read_file(m.path);
  if (!bytes) return print_problems({std::move(bytes.error())});
  auto measured = measure_bytes(*bytes, *options, m.max_pixels);
  if (!measured) {
    if (measured.error().field.empty()) measured.error().field = input_name(m.path);
    return print_problems({std::move(measured.error())});
  }
  auto done = write(m, *bytes, *measured);
  return done ? kExitDone : print_problems({std::move(done.error())});
}

}  // namespace tessera

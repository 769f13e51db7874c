#include "tessera/cli/measure_command.h"

#include <fmt/format.h>

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
#include "tessera/statistics/classes.h"

namespace tessera {
namespace {

constexpr std::uint64_t kMaxPixels = 100'000'000;

void check(const Measure& m, Problems& problems) {
  const auto wrong = [&](const char* field, std::string message) {
    problems.push_back({StatusCode::kInvalidParameter, field, std::move(message)});
  };
  std::vector<std::string> names;
  for (const auto& model : statistics::cell_models()) names.emplace_back(model.name);
  if (!m.model.empty() && std::find(names.begin(), names.end(), m.model) == names.end())
    wrong("model", fmt::format("is {}, expected {}", shown(Json(m.model)), either_of(names)));
  if (!m.model.empty() && !(m.lambda > 0 && m.lambda < 1e9))
    wrong("lambda", "is missing or not above 0, expected the model's number");
  if (std::any_of(m.distances.begin(), m.distances.end(), [](double d) { return !(d > 0 && d < 1e9); }))
    wrong("distances", "are not all above 0, expected lengths");
  if (std::any_of(m.window.begin(), m.window.end(), [](double d) { return !(d > 0 && d < 1e9); }))
    wrong("window", "is not above 0, expected a width and a height");
  if (m.needles < 1 || m.needles > 100'000'000) wrong("needles", "is out of range, expected 1 to 100000000");
  if (m.colors == 1 || m.colors < 0 || m.colors > statistics::kMostClasses)
    wrong("colors",
          fmt::format("is {}, expected 2 to {}, or 0 for as many as there are", m.colors, statistics::kMostClasses));
  for (const std::string& path : m.outputs) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (path != "-" && extension != ".json" && extension != ".csv") wrong(path.c_str(), "is neither .json nor .csv");
  }
}

MeasureOptions options_of(const Measure& m) {
  MeasureOptions options;
  for (const auto& model : statistics::cell_models())
    if (model.name == m.model) options.comparison = Comparison{model.model, m.lambda};
  options.distances = m.distances;
  options.needles = m.needles;
  options.colors = m.colors;
  if (m.window.size() == 2) options.width = m.window[0], options.height = m.window[1];
  options.seed = m.seed;
  return options;
}

bool looks_like_text(const std::string& bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string::npos) return true;
  const auto is_text = [](unsigned char c) { return c >= 0x20 || c == '\n' || c == '\r' || c == '\t'; };
  return std::all_of(bytes.begin(),
                     bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 64)), is_text) &&
         bytes.compare(0, 2, "BM") != 0 && bytes.compare(0, 4, "RIFF") != 0;
}

Result<Measured> measure_bytes(const std::string& bytes, const Measure& m) {
  RunContext context;
  context.stop = &stop_flag();
  if (looks_like_text(bytes)) {
    auto file = read_pattern_file(bytes);
    if (!file) return tl::unexpected<Status>(std::move(file.error()));
    return measure_pattern(*file, options_of(m), context);
  }
  auto picture = decode_picture({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                                m.max_pixels > 0 ? m.max_pixels : kMaxPixels);
  if (!picture) return tl::unexpected<Status>(std::move(picture.error()));
  return measure_picture(picture->view(), options_of(m), context);
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
  check(m, problems);
  if (!problems.empty()) return print_problems(problems);
  auto bytes = read_file(m.path);
  if (!bytes) return print_problems({std::move(bytes.error())});
  auto measured = measure_bytes(*bytes, m);
  if (!measured) {
    if (measured.error().field.empty()) measured.error().field = input_name(m.path);
    return print_problems({std::move(measured.error())});
  }
  auto done = write(m, *bytes, *measured);
  return done ? kExitDone : print_problems({std::move(done.error())});
}

}  // namespace tessera

#include "tessera/job/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tessera/base/portable_math.h"
#include "tessera/base/text.h"
#include "tessera/job/job_json.h"
#include "tessera/statistics/cells.h"
#include "tessera/statistics/classes.h"
#include "tessera/statistics/needles.h"
#include "tessera/statistics/points.h"

namespace tessera {
namespace {

constexpr int kDistances = 24;
constexpr double kPixelsACell = 24;  // along a mean cell, where cells are drawn to throw needles on
constexpr int kAreaSteps = 60;       // of the areas' distribution, to the largest

// Six digits: more would be noise.
double rounded(double v) {
  if (v == 0 || !std::isfinite(v)) return 0;
  const double scale = std::pow(10.0, 5 - std::floor(std::log10(std::abs(v))));
  return std::round(v * scale) / scale;
}

Json rounded(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double v : values) list.push_back(rounded(v));
  return list;
}

// Evenly spaced up to `longest`, or what was asked for.
std::vector<double> distances_of(const MeasureOptions& options, double longest) {
  std::vector<double> distances;
  for (const double d : options.distances)
    if (d < longest * 2) distances.push_back(d);
  std::sort(distances.begin(), distances.end());
  for (int k = 1; k <= kDistances && options.distances.empty(); ++k) distances.push_back(longest * k / kDistances);
  return distances;
}

std::vector<double> expected_same_cell(const std::optional<Comparison>& with, const std::vector<double>& distances) {
  std::vector<double> expected;
  if (!with || statistics::same_cell_chance(with->model, with->x, 0) < 0) return expected;
  for (const double d : distances) expected.push_back(statistics::same_cell_chance(with->model, with->x, d));
  return expected;
}

std::vector<Point> curve(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i]});
  return points;
}

Curves curves_of(std::string title, std::string y_label, const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& expected) {
  Curves plot{std::move(title), "distance, px", std::move(y_label), false, {}, {}};
  plot.series.push_back({"measured", curve(x, y)});
  if (!expected.empty()) plot.series.push_back({"closed form", curve(x, expected)});
  return plot;
}

std::string table(const std::vector<std::pair<std::string, std::vector<double>>>& columns) {
  std::string csv;
  for (const auto& [name, values] : columns) csv += (csv.empty() ? "" : ",") + name;
  csv += '\n';
  for (std::size_t row = 0; row < columns[0].second.size(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      csv += fmt::format("{}{}", c > 0 ? "," : "", rounded(columns[c].second[row]));
    csv += '\n';
  }
  return csv;
}

// The model and number of the pattern job in a file.
std::optional<Comparison> comparison_of(const std::string& job_json) {
  const auto job = read_job(job_json);
  if (!job) return {};
  const auto* params = std::get_if<patterns::Params>(&job->params);
  if (!params || params->process != patterns::Process::kPoisson) return {};
  const double intensity = patterns::driving_intensity(*params);
  using patterns::Model, statistics::CellModel;
  Comparison with{CellModel::kOccupancy, intensity};
  switch (params->model) {
    case Model::kOccupancy: break;
    case Model::kPoissonLines: with.model = CellModel::kPoissonLines; break;
    case Model::kDelaunay: with.model = CellModel::kDelaunay; break;
    case Model::kJohnsonMehl: with = {CellModel::kJohnsonMehl, intensity / params->speed}; break;
    case Model::kCheckerboard: with = {CellModel::kCheckerboard, params->size}; break;
    case Model::kHexagon: with = {CellModel::kHexagon, params->size}; break;
    case Model::kTriangle: with = {CellModel::kTriangle, params->size}; break;
    default: return {};
  }
  if (!(with.x > 0)) return {};
  return with;
}

Json comparison_json(const std::optional<Comparison>& with) {
  if (!with) return nullptr;
  const auto& all = statistics::cell_models();
  const auto named = std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.model == with->model; });
  return {{"model", named->name}, {"lambda", with->x}};
}

// ---- Pictures

std::vector<double> histogram_of(const cv::Mat3b& pixels, int channel) {
  std::vector<double> counts(256, 0);
  for (const cv::Vec3b& p : pixels) ++counts[p[channel]];
  return counts;
}

Json classes_json(const statistics::Classes& classes) {
  const auto shares = statistics::shares_of(classes), widths = statistics::patch_widths(classes);
  Json list = Json::array();
  for (std::size_t k = 0; k < shares.size(); ++k)
    list.push_back({{"colour", colour_text(classes.colours[k])},
                    {"share", rounded(shares[k])},
                    {"patch_width_px", rounded(widths[k])}});
  return list;
}

Json matrix(const double* values, std::size_t side) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < side; ++i)
    rows.push_back(rounded(std::vector<double>(values + i * side, values + (i + 1) * side)));
  return rows;
}

Json needles_json(const std::vector<statistics::NeedleStatistics>& needles, const std::vector<double>& expected,
                  std::size_t classes) {
  Json list = Json::array();
  for (std::size_t i = 0; i < needles.size(); ++i) {
    const statistics::NeedleStatistics& s = needles[i];
    Json entry = {{"d", rounded(s.distance)},
                  {"needles", s.needles},
                  {"same_cell", rounded(s.same_cell)},
                  {"same_cell_error", rounded(s.same_cell_error)}};
    if (!expected.empty()) entry["expected"] = rounded(expected[i]);
    entry["variogram"] = rounded(s.variogram);
    entry["autocorrelation"] = rounded(s.autocorrelation);
    entry["transitions"] = matrix(s.transitions.data(), classes);
    entry["co_occurrence"] = matrix(s.co_occurrence.data(), statistics::kGreyBins);
    entry["difference"] = rounded(std::vector<double>(s.difference.begin(), s.difference.end()));
    list.push_back(std::move(entry));
  }
  return list;
}

// P_ij(d) = p_j (1 - W) + delta_ij W.
Curves transitions_plot(const std::vector<statistics::NeedleStatistics>& needles, std::size_t classes) {
  constexpr std::size_t kMostShown = 4;
  Curves plot{"Staying in a colour", "distance, px", "P of the same colour", false, {}, {}};
  for (std::size_t k = 0; k < std::min(classes, kMostShown); ++k) {
    Curves::Series series{fmt::format("colour {}", k + 1), {}};
    for (const auto& s : needles) series.points.push_back({s.distance, s.transitions[k * classes + k]});
    plot.series.push_back(std::move(series));
  }
  return plot;
}

template <class Get>
std::vector<double> column(const std::vector<statistics::NeedleStatistics>& needles, Get&& get) {
  std::vector<double> values;
  for (const auto& s : needles) values.push_back(get(s));
  return values;
}

// ---- Cells and points

Window window_of(const PatternFile& file, const MeasureOptions& options) {
  if (options.width > 0 && options.height > 0) return {{0, 0}, {options.width, options.height}};
  if (file.window.size().x > 0 && file.window.size().y > 0) return file.window;
  Window box{{1e300, 1e300}, {-1e300, -1e300}};
  const auto take = [&](Point p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  };
  for (const Ring& ring : file.cells)
    for (const Point p : ring) take(p);
  for (const Point p : file.points) take(p);
  return box;
}

Json moment_json(const statistics::Moment& m, double expected, double expected_variance = -1) {
  Json json = {{"mean", rounded(m.mean)}, {"error", rounded(m.error)}, {"variance", rounded(m.variance)}};
  if (expected > 0) json["expected"] = rounded(expected);
  if (expected_variance >= 0) json["expected_variance"] = rounded(expected_variance);
  return json;
}

// What share of cells is no larger than each area. Lattices alone have a closed form: all their cells are alike.
Curves areas_plot(const statistics::CellStatistics& s, const statistics::TypicalCell& typical) {
  Curves plot{"Areas", "area, px²", "share of cells that are no larger", false, {}, {}};
  const double largest = s.areas.empty() ? 1 : s.areas.back().value;
  Curves::Series measured{"measured", {}};
  double below = 0;
  std::size_t next = 0;
  for (int step = 0; step <= kAreaSteps; ++step) {
    const double area = step < kAreaSteps ? largest * step / kAreaSteps : largest;
    while (next < s.areas.size() && s.areas[next].value <= area) below += s.areas[next++].weight / s.per_area;
    measured.points.push_back({area, below});
  }
  plot.series.push_back(std::move(measured));
  if (typical.area > 0 && typical.area_variance == 0) {
    const double end = std::max(largest, typical.area);
    plot.series.push_back({"closed form", {{0, 0}, {typical.area, 0}, {typical.area, 1}, {end, 1}}});
  }
  return plot;
}

Histogram sides_plot(const statistics::CellStatistics& s) {
  constexpr std::size_t kFewest = 3;
  Histogram plot{"Sides", "sides of a cell", "share of cells", {}, {{"measured", {}}}};
  for (std::size_t sides = kFewest; sides < s.side_shares.size(); ++sides) {
    plot.bins.push_back(fmt::format("{}", sides));
    plot.series[0].values.push_back(s.side_shares[sides]);
  }
  return plot;
}

// W(d) length after length, as long as one may go on.
Result<std::vector<double>> same_cell(const cv::Mat1i& drawn, const std::vector<double>& distances, int needles,
                                      Rng& rng, const RunContext& context) {
  std::vector<double> all;
  for (const double d : distances) {
    if (auto go_on = context.check(); !go_on) return tl::unexpected<Status>(std::move(go_on.error()));
    all.push_back(statistics::same_cell(drawn, {d}, needles, rng)[0]);
    context.progress(static_cast<double>(all.size()) / static_cast<double>(distances.size()));
  }
  return all;
}

Result<Measured> measure_cells(const PatternFile& file, const Window& window, const MeasureOptions& options,
                               const std::optional<Comparison>& with, const RunContext& context) {
  context.stage("cells");
  const statistics::CellStatistics s = statistics::cell_statistics(file.cells, window);
  const double side = std::sqrt(window.area() / static_cast<double>(file.cells.size()));
  context.stage("needles");
  const double shorter = std::min(window.size().x, window.size().y);
  const std::vector<double> distances = distances_of(options, std::min(3 * side, shorter / 2));
  // Large mosaics are drawn coarser, so that the picture stays within 64 megapixels.
  const double pixel = std::max(side / kPixelsACell, std::sqrt(window.area() / 6.4e7));
  Rng rng(options.seed, RngPurpose::kSites);
  std::vector<double> in_pixels;
  for (const double d : distances) in_pixels.push_back(d / pixel);
  const cv::Mat1i drawn = statistics::draw_cells(file.cells, window, pixel);
  const auto thrown = same_cell(drawn, in_pixels, options.needles, rng, context);
  if (!thrown) return tl::unexpected<Status>(thrown.error());
  const std::vector<double>& same = *thrown;
  const std::vector<double> expected = expected_same_cell(with, distances);
  const statistics::TypicalCell typical =
      with ? statistics::typical_cell(with->model, with->x) : statistics::TypicalCell{0, 0, 0, 0, -1};

  Measured measured;
  measured.json = {{"kind", "cells"},
                   {"window", {window.low.x, window.low.y, window.high.x, window.high.y}},
                   {"comparison", comparison_json(with)},
                   {"cells", s.cells},
                   {"inner_cells", s.inner},
                   {"cells_per_area", rounded(s.per_area)}};
  if (typical.per_area > 0) measured.json["expected_cells_per_area"] = rounded(typical.per_area);
  measured.json["area"] = moment_json(s.area, typical.area, typical.area_variance);
  measured.json["perimeter"] = moment_json(s.perimeter, typical.perimeter);
  measured.json["sides"] = moment_json(s.sides, typical.sides);
  measured.json["side_shares"] = rounded(s.side_shares);
  measured.json["same_cell"] = Json::array();
  for (std::size_t i = 0; i < distances.size(); ++i) {
    Json entry = {{"d", rounded(distances[i])}, {"value", rounded(same[i])}};
    if (!expected.empty()) entry["expected"] = rounded(expected[i]);
    measured.json["same_cell"].push_back(std::move(entry));
  }
  std::vector<std::pair<std::string, std::vector<double>>> columns = {{"d", distances}, {"same_cell", same}};
  if (!expected.empty()) columns.emplace_back("expected", expected);
  measured.csv = table(columns);
  measured.plots.push_back(
      {"same_cell", curves_of("Both ends of a needle in one cell", "W", distances, same, expected)});
  measured.plots.push_back({"areas", areas_plot(s, typical)});
  measured.plots.push_back({"sides", sides_plot(s)});
  return measured;
}

Result<Measured> measure_points(const PatternFile& file, const Window& window, const MeasureOptions& options,
                                const RunContext& context) {
  context.stage("points");
  const double share = std::sqrt(window.area() / static_cast<double>(file.points.size()));
  const double shorter = std::min(window.size().x, window.size().y);
  std::vector<Point> inside;
  for (const Point p : file.points)
    if (p.x >= window.low.x && p.x <= window.high.x && p.y >= window.low.y && p.y <= window.high.y)
      inside.push_back(p);
  const std::vector<double> radii = distances_of(options, std::min(4 * share, shorter / 4));
  const statistics::PointStatistics s = statistics::point_statistics(inside, window, radii);
  std::vector<double> poisson;
  for (const double r : radii) poisson.push_back(kPi * r * r);

  Measured measured;
  measured.json = {{"kind", "points"},
                   {"window", {window.low.x, window.low.y, window.high.x, window.high.y}},
                   {"points", inside.size()},
                   {"outside", file.points.size() - inside.size()},
                   {"intensity", rounded(s.intensity)},
                   {"nearest_mean", rounded(s.nearest)},
                   {"nearest_poisson", s.intensity > 0 ? rounded(0.5 / std::sqrt(s.intensity)) : 0}};
  measured.json["ripley"] = Json::array();
  for (std::size_t i = 0; i < radii.size(); ++i)
    measured.json["ripley"].push_back({{"t", rounded(radii[i])},
                                       {"k", rounded(s.k[i])},
                                       {"poisson", rounded(poisson[i])},
                                       {"pair_correlation", rounded(s.pair_correlation[i])}});
  measured.csv = table({{"t", radii}, {"k", s.k}, {"poisson", poisson}, {"pair_correlation", s.pair_correlation}});
  measured.plots.push_back({"ripley_k", curves_of("Ripley's K", "K", radii, s.k, poisson)});
  measured.plots.push_back({"pair_correlation", curves_of("Pair correlation", "g", radii, s.pair_correlation,
                                                          std::vector<double>(radii.size(), 1))});
  return measured;
}

}  // namespace

Result<Measured> measure_picture(const ImageView& picture, const MeasureOptions& options, const RunContext& context) {
  if (!picture.pixels || picture.width < 2 || picture.height < 2)
    return fail(StatusCode::kInvalidInput, "", "is smaller than 2 x 2 pixels, expected more");
  context.stage("classes");
  const statistics::Classes classes = statistics::find_classes(picture, options.colors);
  context.stage("needles");
  const double shorter = std::min(picture.width, picture.height);
  const std::vector<double> distances = distances_of(options, std::min(shorter / 4, 96.0));
  Rng rng(options.seed, RngPurpose::kSites);
  const auto needles = statistics::throw_needles(picture, classes, distances, options.needles, rng, context);
  if (auto go_on = context.check(); !go_on) return tl::unexpected<Status>(std::move(go_on.error()));
  const std::vector<double> expected = expected_same_cell(options.comparison, distances);
  const auto same = column(needles, [](const auto& s) { return s.same_cell; });
  const auto variogram = column(needles, [](const auto& s) { return s.variogram; });
  const auto correlation = column(needles, [](const auto& s) { return s.autocorrelation; });

  Measured measured;
  measured.json = {{"kind", "picture"},
                   {"width", picture.width},
                   {"height", picture.height},
                   {"comparison", comparison_json(options.comparison)},
                   {"classes", classes_json(classes)},
                   {"crossings_per_px", rounded(statistics::boundary_crossings(classes))}};
  const cv::Mat3b pixels = picture.mat();
  const char* const channels[] = {"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) measured.json["histogram"][channels[c]] = rounded(histogram_of(pixels, c));
  measured.json["needles"] = needles_json(needles, expected, classes.colours.size());

  std::vector<std::pair<std::string, std::vector<double>>> columns = {{"d", distances}, {"same_cell", same}};
  if (!expected.empty()) columns.emplace_back("expected", expected);
  columns.emplace_back("variogram", variogram);
  columns.emplace_back("autocorrelation", correlation);
  measured.csv = table(columns);
  measured.plots.push_back(
      {"same_cell", curves_of("Both ends of a needle in one cell", "W", distances, same, expected)});
  measured.plots.push_back({"variogram", curves_of("Variogram", "V, levels squared", distances, variogram, {})});
  measured.plots.push_back(
      {"autocorrelation", curves_of("Autocorrelation of grey levels", "rho", distances, correlation, expected)});
  measured.plots.push_back({"transitions", transitions_plot(needles, classes.colours.size())});
  return measured;
}

Result<Measured> measure_pattern(const PatternFile& file, const MeasureOptions& options, const RunContext& context) {
  const Window window = window_of(file, options);
  if (!(window.size().x > 0 && window.size().y > 0))
    return fail(StatusCode::kInvalidInput, "", "has a window without an area, expected --window");
  const auto with = options.comparison ? options.comparison : comparison_of(file.job_json);
  if (file.cells.empty()) return measure_points(file, window, options, context);
  return measure_cells(file, window, options, with, context);
}

}  // namespace tessera

#include "tessera/job/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "tessera/base/portable_math.h"
#include "tessera/base/text.h"
#include "tessera/job/job_json.h"
#include "tessera/patterns/run.h"
#include "tessera/statistics/borders.h"
#include "tessera/statistics/cells.h"
#include "tessera/statistics/classes.h"
#include "tessera/statistics/closed_forms.h"
#include "tessera/statistics/needles.h"

namespace tessera {
namespace {

using patterns::Model;
using statistics::Classes;

constexpr double kWantedSpacing = 10;  // px between borders of the reduced picture
constexpr int kLargestSide = 800;      // px, of what marks are taken from
constexpr int kNeedles = 60000;        // a length, of the picture itself
constexpr int kMarkNeedles = 15000;    // a length, for marks
constexpr int kOwnPictures = 5;        // of each model
constexpr int kLengths = 12;

// What is looked at: classes without colours, reduced so that borders are a few pixels apart.
struct Labels {
  cv::Mat1b map;
  double factor = 1;           // pixels of the picture to one of these
  std::vector<double> shares;  // of the classes
  double by_chance = 0;        // the chance that two cells have one class
};

Labels reduced(const Classes& classes) {
  const double crossings = std::max(statistics::boundary_crossings(classes), 1e-6);
  const int by_spacing = static_cast<int>(1 / crossings / kWantedSpacing);
  const int factor = std::clamp(by_spacing, 1, std::max(1, std::min(classes.labels.rows, classes.labels.cols) / 64));
  Labels labels;
  labels.factor = factor;
  labels.map.create(classes.labels.rows / factor, classes.labels.cols / factor);
  for (int y = 0; y < labels.map.rows; ++y)
    for (int x = 0; x < labels.map.cols; ++x)
      labels.map(y, x) = classes.labels(y * factor + factor / 2, x * factor + factor / 2);
  labels.shares = statistics::shares_of(classes);
  labels.by_chance = statistics::agreement_by_chance(labels.shares);
  return labels;
}

// ---- W(d)

// W(d) of labels, by needles: of lengths up to three spacings.
struct Curve {
  std::vector<double> lengths, values;
};

Curve measured_curve(const Labels& labels, double spacing, int needles, Rng& rng) {
  Curve curve;
  const double longest = std::min(2.5 * spacing, std::min(labels.map.rows, labels.map.cols) / 3.0);
  for (int k = 1; k <= kLengths; ++k) curve.lengths.push_back(longest * k / kLengths);
  // The labels' shares are those of the picture, whatever these few cells have.
  const cv::Mat1i map = cv::Mat1i(labels.map);
  for (const double agree : statistics::same_cell(map, curve.lengths, needles, rng))
    curve.values.push_back((agree - labels.by_chance) / (1 - labels.by_chance));
  return curve;
}

// The same by all pairs of pixels at short distances: where W(d) tells most of how many cells there are, and without
// the chance of needles. Directions are enough for those of lattices to even out.
Curve short_curve(const Labels& labels, double spacing) {
  constexpr int kDirections = 24;
  Curve curve;
  for (const double part : {0.2, 0.4, 0.6}) {
    for (int k = 0; k < kDirections; ++k) {
      const SinCos turn = sin_cos(k * kPi / kDirections);
      const cv::Point offset(cvRound(part * spacing * turn.cos), cvRound(part * spacing * turn.sin));
      const double agree = statistics::agreement(labels.map, offset);
      curve.lengths.push_back(length({static_cast<double>(offset.x), static_cast<double>(offset.y)}));
      curve.values.push_back((agree - labels.by_chance) / (1 - labels.by_chance));
    }
  }
  return curve;
}

// W of a model against d times the square root of cells an area; a table, since some have none but a simulated one.
class Form {
 public:
  explicit Form(const std::function<double(double)>& exact) {
    for (int k = 0; k <= kSteps; ++k) table_.push_back(exact(kReach * k / kSteps));
  }
  double at(double u) const {
    const double place = std::clamp(u / kReach, 0.0, 1.0) * kSteps;
    const int k = std::min(kSteps - 1, static_cast<int>(place));
    return table_[k] + (place - k) * (table_[k + 1] - table_[k]);
  }

 private:
  static constexpr int kSteps = 80;
  static constexpr double kReach = 4;
  std::vector<double> table_;
};

double residual_of(const Curve& curve, const Form& form, double cells) {
  double sum = 0;
  for (std::size_t i = 0; i < curve.lengths.size(); ++i) {
    const double off = curve.values[i] - form.at(curve.lengths[i] * std::sqrt(cells));
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(curve.lengths.size()));
}

// The cells an area whose curve is the nearest, about a first guess: golden section over their root, which lengths
// scale with.
double nearest_density(const Curve& curve, const Form& form, double guess) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  const auto off = [&](double root) { return residual_of(curve, form, root * root); };
  double low = std::sqrt(guess / 2.5), high = std::sqrt(guess * 2.5);
  for (int step = 0; step < 30; ++step) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (off(a) < off(b))
      high = b;
    else
      low = a;
  }
  return (low + high) * (low + high) / 4;
}

// ---- Models

struct CellModel {
  Model model;
  statistics::CellModel form;
  double border;  // length of borders an area where there is one cell an area
};

// 3.2 and 3.3; the length of borders from the closed forms, for Johnson-Mehl from a simulation of a million cells.
const CellModel kModels[] = {{Model::kPoissonLines, statistics::CellModel::kPoissonLines, std::sqrt(kPi)},
                             {Model::kOccupancy, statistics::CellModel::kOccupancy, 2},
                             {Model::kDelaunay, statistics::CellModel::kDelaunay, 2.40084},
                             {Model::kJohnsonMehl, statistics::CellModel::kJohnsonMehl, 1.86717},
                             {Model::kCheckerboard, statistics::CellModel::kCheckerboard, 2},
                             {Model::kHexagon, statistics::CellModel::kHexagon, 1.86121},
                             {Model::kTriangle, statistics::CellModel::kTriangle, 2.27951}};

// The model's number for so many cells an area.
double number_of(const CellModel& model, double cells) {
  switch (model.model) {
    case Model::kPoissonLines: return std::sqrt(cells / kPi);
    case Model::kOccupancy: return cells;
    case Model::kDelaunay: return cells / 2;
    case Model::kJohnsonMehl: return cells / 0.8794 * std::sqrt(cells / 0.8794);
    default: return 1 / std::sqrt(cells * statistics::typical_cell(model.form, 1).area);
  }
}

bool is_lattice(const CellModel& model) { return statistics::typical_cell(model.form, 1).area_variance == 0; }

patterns::Params params_of(const CellModel& model, double cells, double width, double height) {
  patterns::Params params;
  params.model = model.model;
  params.width = width;
  params.height = height;
  const double number = number_of(model, cells);
  (is_lattice(model) ? params.size : params.intensity) = number;
  return params;
}

std::vector<Ring> cells_of(const patterns::Params& params, std::uint64_t seed) {
  std::vector<Ring> rings;
  auto output = patterns::run({}, params, seed, {});
  if (!output) return rings;
  for (Piece& piece : output->sheet.pieces) rings.push_back(std::move(piece.outline.outer));
  return rings;
}

// A picture of the model's, coloured with the same shares.
Labels own_picture(const CellModel& model, double cells, const Labels& like, std::uint64_t seed) {
  const patterns::Params params = params_of(model, cells, like.map.cols, like.map.rows);
  const std::vector<Ring> rings = cells_of(params, seed);
  const cv::Mat1i drawn = statistics::draw_cells(rings, {{0, 0}, {params.width, params.height}}, 1);
  Rng rng(seed, RngPurpose::kColours);
  std::vector<std::uint8_t> class_of(rings.size());
  for (std::uint8_t& label : class_of) {
    double rest = rng.uniform();
    label = 0;
    while (label + 1u < like.shares.size() && (rest -= like.shares[label]) >= 0) ++label;
  }
  Labels own{cv::Mat1b(like.map.size(), std::uint8_t{0}), 1, like.shares, like.by_chance};
  for (int y = 0; y < drawn.rows; ++y)
    for (int x = 0; x < drawn.cols; ++x)
      if (drawn(y, x) >= 0) own.map(y, x) = class_of[drawn(y, x)];
  return own;
}

Form form_of(const CellModel& model) {
  if (statistics::same_cell_chance(model.form, 1, 0) >= 0) {
    const double number = number_of(model, 1);
    return Form([&](double u) { return statistics::same_cell_chance(model.form, number, u); });
  }
  // Of a simulation: 14,400 cells, 12 px each along a side.
  constexpr double kSide = 12, kAcross = 120;
  const patterns::Params params = params_of(model, 1 / (kSide * kSide), kSide * kAcross, kSide * kAcross);
  const cv::Mat1i drawn = statistics::draw_cells(cells_of(params, 1), {{0, 0}, {params.width, params.height}}, 1);
  return Form([&](double u) {
    Rng rng(1, RngPurpose::kSites);
    return u > 0 ? statistics::same_cell(drawn, {u * kSide}, 20000, rng)[0] : 1;
  });
}

// ---- Marks

using Marks = std::vector<double>;

// Marks of the borders, then W(d) at the same lengths: figures by which models differ.
Marks marks_of(const Labels& labels, double spacing, Rng& rng) {
  const cv::Rect part(0, 0, std::min(labels.map.cols, kLargestSide), std::min(labels.map.rows, kLargestSide));
  Marks marks = statistics::border_marks(labels.map(part).clone(), spacing);
  for (const double w : measured_curve(labels, spacing, kMarkNeedles, rng).values) marks.push_back(w);
  return marks;
}

Marks mean_of(const std::vector<Marks>& samples) {
  Marks mean(samples[0].size(), 0);
  for (const Marks& sample : samples)
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += sample[k] / static_cast<double>(samples.size());
  return mean;
}

// How far marks are apart, in standard deviations of a mark on average (Mahalanobis). Five pictures of a model are
// few to tell how its marks vary together: all models' are pooled, and what two marks share counts for less. By plain
// sums, the same on every platform.
class Nearness {
 public:
  // Of each model the marks of its own pictures.
  explicit Nearness(const std::vector<std::vector<Marks>>& own)
      : root_(own[0][0].size(), Marks(own[0][0].size(), 0)) {
    constexpr double kShared = 0.7, kLeast = 1e-5;
    double freedom = 0;
    for (const std::vector<Marks>& samples : own) {
      add_variation(samples);
      freedom += static_cast<double>(samples.size()) - 1;
    }
    for (std::size_t i = 0; i < root_.size(); ++i)
      for (std::size_t k = 0; k <= i; ++k)
        root_[i][k] = i == k ? root_[i][k] / freedom + kLeast : kShared * root_[i][k] / freedom;
    factor();
  }

  // The length of L^-1 (a - b).
  double distance(const Marks& a, const Marks& b) const {
    Marks off(a.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      off[i] = a[i] - b[i];
      for (std::size_t k = 0; k < i; ++k) off[i] -= root_[i][k] * off[k];
      off[i] /= root_[i][i];
      sum += off[i] * off[i];
    }
    return std::sqrt(sum / static_cast<double>(a.size()));
  }

 private:
  void add_variation(const std::vector<Marks>& samples) {
    const Marks mean = mean_of(samples);
    for (const Marks& sample : samples)
      for (std::size_t i = 0; i < mean.size(); ++i)
        for (std::size_t k = 0; k <= i; ++k) root_[i][k] += (sample[i] - mean[i]) * (sample[k] - mean[k]);
  }

  // The covariance becomes its L of L L^T (Cholesky); what two marks share has been lessened, so there is one.
  void factor() {
    for (std::size_t i = 0; i < root_.size(); ++i)
      for (std::size_t k = 0; k <= i; ++k) {
        for (std::size_t m = 0; m < k; ++m) root_[i][k] -= root_[i][m] * root_[k][m];
        root_[i][k] = i == k ? std::sqrt(root_[i][i]) : root_[i][k] / root_[k][k];
      }
  }

  std::vector<Marks> root_;  // lower triangular
};

// ---- What is seen, and what could explain it

struct Look {
  Labels labels;
  double spacing;  // between changes of class along a line, px of the labels
  Curve curve, close;
  Marks marks;

  // Of borders an area: a straight line of length d crosses 2 / pi of it.
  double border() const { return kPi / 2 / spacing; }
};

Look look_at(const Classes& classes, Rng& rng) {
  constexpr double kShort = 2;
  Look look{reduced(classes), 0, {}, {}, {}};
  const double agree = statistics::same_cell(cv::Mat1i(look.labels.map), {kShort}, kNeedles, rng)[0];
  look.spacing = kShort / std::max(1 - agree, kShort * 1e-6);
  look.curve = measured_curve(look.labels, look.spacing, kNeedles, rng);
  look.close = short_curve(look.labels, look.spacing);
  look.marks = marks_of(look.labels, look.spacing, rng);
  return look;
}

struct Explanation {
  Candidate candidate;
  patterns::Params params;                            // of a pattern like the labels
  int bombs = -1;                                     // the class that lies on the other; -1: cells
  std::function<Labels(std::uint64_t seed)> picture;  // of its own
};

Explanation explain_by_cells(const CellModel& model, const Look& look) {
  const Form form = form_of(model);
  // Borders between cells of one class are not seen.
  const double border = look.border() / (1 - look.labels.by_chance);
  const double guess = (border / model.border) * (border / model.border);
  // A lattice comes again and again: its W(d) tells the side best where it has waves.
  const double cells = nearest_density(is_lattice(model) ? look.curve : look.close, form, guess);
  const double factor = look.labels.factor;
  return {{model.model, number_of(model, cells / (factor * factor)), 0, residual_of(look.curve, form, cells)},
          params_of(model, cells, look.labels.map.cols, look.labels.map.rows),
          -1,
          [&model, cells, &look](std::uint64_t seed) { return own_picture(model, cells, look.labels, seed); }};
}

// Discs dropped at random (4 c): they cover p = 1 - exp(-lambda pi r^2), the chance that they cover both ends of a
// needle tells their diameter.
Explanation explain_by_discs(const Look& look, int bombs) {
  const Labels& labels = look.labels;
  const double covered = labels.shares[static_cast<std::size_t>(bombs)], hits = -std::log(1 - covered);
  const Form form([&](double diameters) {
    const double agree = 1 - 2 * covered + 2 * statistics::both_covered(covered, diameters);
    return (agree - labels.by_chance) / (1 - labels.by_chance);
  });
  // Borders of 2 pi r lambda (1 - p) an area, for a first guess.
  const double guess = look.border() / (4 * hits * (1 - covered));
  const double a_diameter = std::sqrt(nearest_density(look.close, form, guess * guess));
  patterns::Params params;
  params.model = Model::kCircles;
  params.width = labels.map.cols;
  params.height = labels.map.rows;
  params.length = 1 / a_diameter;
  params.intensity = hits * 4 / kPi * a_diameter * a_diameter;
  return {{Model::kCircles, params.intensity / (labels.factor * labels.factor), 0,
           residual_of(look.curve, form, a_diameter * a_diameter)},
          params,
          bombs,
          [params, &look, bombs](std::uint64_t seed) {
            const cv::Mat1i drawn =
                statistics::draw_cells(cells_of(params, seed), {{0, 0}, {params.width, params.height}}, 1);
            Labels own = look.labels;
            own.map = cv::Mat1b(drawn.size(), static_cast<std::uint8_t>(1 - bombs));
            own.map.setTo(bombs, drawn >= 0);
            return own;
          }};
}

// Refers to `look`, which is to stay.
std::vector<Explanation> explain(const Look& look) {
  std::vector<Explanation> explanations;
  for (const CellModel& model : kModels) explanations.push_back(explain_by_cells(model, look));
  if (look.labels.shares.size() == 2)
    for (const int bombs : {0, 1}) explanations.push_back(explain_by_discs(look, bombs));
  return explanations;
}

// Classes change only at whole multiples of one step, in both directions, and as often as by chance: noise.
int noise_step(const Classes& classes) {
  const cv::Mat1b& labels = classes.labels;
  int step = 0;
  for (int x = 1; x < labels.cols; ++x)
    if (cv::countNonZero(labels.col(x) != labels.col(x - 1)) > 0) step = std::gcd(step, x);
  for (int y = 1; y < labels.rows; ++y)
    if (cv::countNonZero(labels.row(y) != labels.row(y - 1)) > 0) step = std::gcd(step, y);
  if (step == 0) return 0;
  const double changes = statistics::boundary_crossings(classes) * step;
  const double by_chance = 1 - statistics::agreement_by_chance(statistics::shares_of(classes));
  return std::abs(changes - by_chance) < 0.1 * by_chance ? step : 0;
}

void take_colours(const Classes& classes, patterns::Params& params) {
  params.colors.clear();
  params.probabilities.clear();
  for (std::size_t k = 0; k < classes.colours.size(); ++k) {
    const char* const space = k > 0 ? " " : "";
    params.colors += fmt::format("{}{}", space, colour_text(classes.colours[k]));
    params.probabilities += fmt::format("{}{:.4f}", space, std::max(statistics::shares_of(classes)[k], 1e-4));
  }
}

// Of more of the same, as large as the picture.
patterns::Params params_of(const Explanation& explanation, const Classes& classes, const ImageView& picture) {
  patterns::Params params = explanation.params;
  params.width = picture.width;
  params.height = picture.height;
  take_colours(classes, params);
  if (explanation.bombs < 0) {
    (params.intensity < 0 ? params.size : params.intensity) = explanation.candidate.number;
    return params;
  }
  const auto bombs = static_cast<std::size_t>(explanation.bombs);
  params.length *= std::sqrt(params.intensity / explanation.candidate.number);
  params.intensity = explanation.candidate.number;
  params.colors = colour_text(classes.colours[bombs]) + " " + colour_text(classes.colours[1 - bombs]);
  params.probabilities.clear();
  return params;
}

Fit noise(const Classes& classes, int step) {
  Fit fit;
  fit.candidates.push_back({Model::kGaussian, static_cast<double>(step), 0, 0});
  fit.params.model = Model::kGaussian;
  fit.params.covariance = std::string("0");
  fit.params.width = std::max(1, classes.labels.cols / step);
  fit.params.height = std::max(1, classes.labels.rows / step);
  take_colours(classes, fit.params);
  return fit;
}

}  // namespace

Result<Fit> fit_pattern(const ImageView& picture, std::uint64_t seed, const RunContext& context) {
  constexpr int kSmallest = 32;
  if (!picture.pixels || std::min(picture.width, picture.height) < kSmallest)
    return fail(StatusCode::kInvalidInput, "",
                fmt::format("is smaller than {0} x {0} pixels, expected more", kSmallest));
  context.stage("classes");
  const Classes classes = statistics::find_classes(picture, 0);
  if (classes.colours.size() < 2 || statistics::boundary_crossings(classes) == 0)
    return fail(StatusCode::kInvalidInput, "", "has one colour only, expected cells of several");
  if (const int step = noise_step(classes)) return noise(classes, step);

  context.stage("marks");
  Rng rng(seed, RngPurpose::kSites);
  const Look look = look_at(classes, rng);

  context.stage("models");
  std::vector<Explanation> explanations = explain(look);
  std::vector<std::vector<Marks>> own;  // of each explanation's own pictures
  for (const Explanation& explanation : explanations) {
    own.emplace_back();
    for (int k = 0; k < kOwnPictures; ++k) {
      if (auto go_on = context.check(); !go_on) return tl::unexpected<Status>(std::move(go_on.error()));
      own.back().push_back(marks_of(explanation.picture(seed + static_cast<std::uint64_t>(k)), look.spacing, rng));
    }
    context.progress(static_cast<double>(own.size()) / static_cast<double>(explanations.size()));
  }
  const Nearness nearness(own);
  for (std::size_t i = 0; i < own.size(); ++i)
    explanations[i].candidate.distance = nearness.distance(look.marks, mean_of(own[i]));
  std::stable_sort(explanations.begin(), explanations.end(), [](const Explanation& a, const Explanation& b) {
    return a.candidate.distance < b.candidate.distance;
  });

  Fit fit;
  fit.params = params_of(explanations.front(), classes, picture);
  for (const Explanation& explanation : explanations) {
    const auto same = [&](const Candidate& c) { return c.model == explanation.candidate.model; };
    if (std::none_of(fit.candidates.begin(), fit.candidates.end(), same))
      fit.candidates.push_back(explanation.candidate);
  }
  return fit;
}

Job job_of(const Fit& fit, std::uint64_t seed) { return {.seed = seed, .params = fit.params, .inputs = {}}; }

Json fit_to_json(const Fit& fit, std::uint64_t seed) {
  Json candidates = Json::array();
  for (const Candidate& c : fit.candidates) {
    patterns::Params params;
    params.model = c.model;
    candidates.push_back({{"model", write_params(params)["model"]},
                          {"lambda", c.number},
                          {"distance", c.distance},
                          {"w_residual", c.residual}});
  }
  return {{"model", candidates[0]["model"]},
          {"lambda", candidates[0]["lambda"]},
          {"candidates", candidates},
          {"job", job_to_json(job_of(fit, seed))}};
}

}  // namespace tessera

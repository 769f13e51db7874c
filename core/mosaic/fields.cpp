#include "tessera/mosaic/fields.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "tessera/base/portable_math.h"
#include "tessera/image/edges.h"
#include "tessera/image/saliency.h"
#include "tessera/mosaic/regions.h"
#include "tessera/voronoi/ridges.h"

namespace tessera::mosaic {
namespace {

constexpr double kNodesPerSide = 3;    // of the coarse grids, a tile's side
constexpr double kSmallestSide = 2.5;  // px
constexpr double kMarginSides = 6;     // width of a torus' margin, in sides of its larger tiles
// Lines that are no edges for rows, but for tiles' corners: against params.edge_detail and params.edge_share.
constexpr double kLineDetail = 0.7, kLineShare = 3;
constexpr int kSmoothingRounds = 20;
constexpr float kOverRelaxation = 1.7f;

// [1 2 1] / 4 in both directions, `rounds` times: a Gaussian of sqrt(rounds / 2) nodes. Written out, since a
// library's order of sums differs between machines.
template <class T>
void smooth(cv::Mat_<T>& nodes, int rounds) {
  cv::Mat_<T> other(nodes.size());
  for (int round = 0; round < rounds; ++round) {
    for (int y = 0; y < nodes.rows; ++y)
      for (int x = 0; x < nodes.cols; ++x)
        other(y, x) =
            (nodes(y, std::max(0, x - 1)) + nodes(y, std::min(nodes.cols - 1, x + 1)) + nodes(y, x) * 2.0f) * 0.25f;
    for (int y = 0; y < nodes.rows; ++y)
      for (int x = 0; x < nodes.cols; ++x)
        nodes(y, x) =
            (other(std::max(0, y - 1), x) + other(std::min(nodes.rows - 1, y + 1), x) + other(y, x) * 2.0f) * 0.25f;
  }
}

cv::Mat3b fitted(const ImageView& picture, cv::Size size) {
  cv::Mat3b out;
  cv::resize(picture.mat(), out, size, 0, 0, cv::INTER_NEAREST);
  return out;
}

// The user's edges: whatever is on the rarer side of Otsu's threshold.
cv::Mat1b drawn_edges(const ImageView& picture, cv::Size size) {
  cv::Mat1b grey, edges;
  cv::cvtColor(fitted(picture, size), grey, cv::COLOR_RGB2GRAY);
  double least, most;
  cv::minMaxLoc(grey, &least, &most);
  if (most - least < 16) return cv::Mat1b::zeros(size);
  cv::threshold(grey, edges, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  if (2 * cv::countNonZero(edges) > static_cast<int>(edges.total())) cv::bitwise_not(edges, edges);
  return edges;
}

DistanceField mountains(const cv::Mat1b& edges, Rasterizer* rasterizer) {
  if (rasterizer && rasterizer->name() == "gl") {
    if (auto heights = ridge_distance(edges, *rasterizer)) return *std::move(heights);
  }
  return edge_distance(edges);
}

// Edges that rows follow, and with finer lines: the field stays calm, while tiles end where colours change.
//
// On a torus the photo's own edges are those within it: where its sides differ, no row runs along them.
void find_edges_and_lines(const Pictures& pictures, const Params& params, double side, Rasterizer* rasterizer,
                          Fields& fields) {
  const bool drawn = pictures.edges.pixels, found = !drawn && params.edge_share > 0;
  const auto photo_edges = [&](double detail, double share, double shortest) {
    return find_edges(pictures.photo.mat(), {.sigma = std::clamp(detail * params.edge_detail * side, 0.6, 8.0),
                                             .share = std::min(0.5, share * params.edge_share),
                                             .shortest = shortest});
  };
  cv::Mat1b edges = cv::Mat1b::zeros(fields.torus.period);
  if (drawn) edges = drawn_edges(pictures.edges, fields.torus.period);
  if (found) edges = photo_edges(1, 1, std::max(6.0, 2.5 * side));
  fields.edges = fields.torus.repeated(edges);
  fields.distance = mountains(fields.edges, rasterizer);
  fields.to_line = fields.distance;
  if (found)
    fields.to_line = edge_distance(fields.torus.repeated<unsigned char>(
        photo_edges(kLineDetail, kLineShare, std::max(3.0, 1.5 * side)) | edges));
}

// (x + i y)^4 of a unit vector: cosine and sine of four times its angle.
cv::Vec2f fourfold(double x, double y) {
  const double c = x * x - y * y, s = 2 * x * y;
  return {static_cast<float>(c * c - s * s), static_cast<float>(2 * c * s)};
}

DirectionField given_direction(const ImageView& picture, const Torus& torus, double step) {
  const cv::Mat3b angles = torus.repeated(fitted(picture, torus.period));
  const cv::Size size = angles.size();
  DirectionField field(size, step);
  cv::Mat2f& nodes = field.nodes();
  for (int j = 0; j < nodes.rows; ++j)
    for (int i = 0; i < nodes.cols; ++i) {
      const int x = std::min(size.width - 1, static_cast<int>(i * step)),
                y = std::min(size.height - 1, static_cast<int>(j * step));
      const SinCos turn = sin_cos(angles(y, x)[1] * (kPi / 255));
      nodes(j, i) = fourfold(turn.cos, turn.sin);
    }
  return field;
}

// Nodes between what `target` says by `weight` and what lies around, which counts `give`: over-relaxed, since
// directions have far to travel where edges are few. `target` comes multiplied by `weight`.
void even_out(cv::Mat2f& nodes, const cv::Mat2f& target, const cv::Mat1f& weight, float give) {
  cv::Mat1f own(nodes.size()), around(nodes.size());
  for (int j = 0; j < nodes.rows; ++j)
    for (int i = 0; i < nodes.cols; ++i) {
      own(j, i) = kOverRelaxation / (weight(j, i) + give);
      around(j, i) = 0.25f * give * own(j, i);
    }
  for (int round = 0; round < kSmoothingRounds; ++round)
    for (int j = 0; j < nodes.rows; ++j) {
      const cv::Vec2f *above = nodes[std::max(0, j - 1)], *below = nodes[std::min(nodes.rows - 1, j + 1)];
      cv::Vec2f* row = nodes[j];
      for (int i = 0; i < nodes.cols; ++i) {
        const cv::Vec2f sum = above[i] + below[i] + row[std::max(0, i - 1)] + row[std::min(nodes.cols - 1, i + 1)];
        row[i] = row[i] * (1 - kOverRelaxation) + target(j, i) * own(j, i) + sum * around(j, i);
      }
    }
}

// The gradient of the distance to the edges (4), evened out: near an edge it stays, between edges it gives way to
// what lies around, so that no seam is left where two edges' realms meet.
DirectionField direction_of(const Fields& fields, const Params& params, double step) {
  DirectionField field(fields.size, step);
  cv::Mat2f& nodes = field.nodes();
  cv::Mat2f target(nodes.size(), cv::Vec2f(0, 0));
  cv::Mat1f weight(nodes.size(), 0.0f);
  const int reach = std::max(2, static_cast<int>(step / 2));
  for (int j = 0; j < nodes.rows; ++j)
    for (int i = 0; i < nodes.cols; ++i) {
      const double x = std::min<double>(i * step, fields.size.width - 1),
                   y = std::min<double>(j * step, fields.size.height - 1);
      const cv::Vec2d up = tessera::uphill(fields.distance, x, y, reach);
      if (up[0] == 0 && up[1] == 0) continue;
      const double away = fields.distance(static_cast<int>(y), static_cast<int>(x)) / fields.side(x, y);
      target(j, i) = fourfold(up[0], up[1]);
      weight(j, i) = static_cast<float>(1 / (0.25 + 8 * away * away));
    }
  for (int j = 0; j < nodes.rows; ++j)
    for (int i = 0; i < nodes.cols; ++i) target(j, i) *= weight(j, i);
  target.copyTo(nodes);
  smooth(nodes, 2);
  if (params.smoothing > 0) even_out(nodes, target, weight, static_cast<float>(params.smoothing));
  // Nothing said anything: rows lie along the picture's sides.
  for (cv::Vec2f& v : nodes)
    if (v.dot(v) < 1e-12f) v = {1, 0};
  return field;
}

// The length of the picture's gradient, |dx| + |dy|.
cv::Mat_<std::uint16_t> steepness(const cv::Mat3b& photo) {
  cv::Mat3b soft;
  cv::GaussianBlur(photo, soft, {3, 3}, 0, 0, cv::BORDER_REPLICATE);
  cv::Mat1b grey;
  cv::cvtColor(soft, grey, cv::COLOR_RGB2GRAY);
  cv::Mat_<std::uint16_t> steep(grey.size());
  for (int y = 0; y < grey.rows; ++y) {
    const std::uint8_t *row = grey[y], *below = grey[std::min(y + 1, grey.rows - 1)];
    for (int x = 0; x < grey.cols; ++x) {
      const int dx = row[std::min(x + 1, grey.cols - 1)] - row[x], dy = below[x] - row[x];
      steep(y, x) = static_cast<std::uint16_t>(std::abs(dx) + std::abs(dy));
    }
  }
  return steep;
}

// The mean of the pixels around each node.
template <class T>
cv::Mat1f means_at(const cv::Mat_<T>& pixels_of, cv::Size nodes, double step) {
  cv::Mat1f sum(nodes, 0.0f), count(nodes, 0.0f);
  for (int y = 0; y < pixels_of.rows; ++y) {
    const T* row = pixels_of[y];
    const int j = std::min(nodes.height - 1, static_cast<int>(std::lround(y / step)));
    float *target = sum[j], *pixels = count[j];
    for (int x = 0; x < pixels_of.cols; ++x) {
      const int i = static_cast<int>(std::lround(x / step));
      target[i] += static_cast<float>(row[x]);
      pixels[i] += 1;
    }
  }
  for (int j = 0; j < nodes.height; ++j)
    for (int i = 0; i < nodes.width; ++i) sum(j, i) = count(j, i) > 0 ? sum(j, i) / count(j, i) : 0;
  return sum;
}

// Distances from the mean colour, which count less towards the corners: people look at the middle first (T. Judd,
// K. Ehinger, F. Durand, A. Torralba, "Learning to Predict Where Humans Look", ICCV 2009), and a photo's corners are
// often darker than the rest. A torus has no middle.
cv::Mat1f salience(const cv::Mat3b& photo, bool has_middle) {
  constexpr float kInCorners = 0.3f;
  const cv::Mat1i squares = saliency_of(photo);
  cv::Mat1f distances(squares.size());
  const auto off_middle = [](int at, int length) {  // squared, 1 at the sides
    const float way = (2 * static_cast<float>(at) + 1) / static_cast<float>(length) - 1;
    return way * way;
  };
  for (int y = 0; y < squares.rows; ++y)
    for (int x = 0; x < squares.cols; ++x) {
      const float far = has_middle ? 0.5f * (off_middle(x, squares.cols) + off_middle(y, squares.rows)) : 0;
      distances(y, x) = (1 - (1 - kInCorners) * far) * std::sqrt(static_cast<float>(squares(y, x)));
    }
  return distances;
}

// 5.2: sides that follow the detail, or what is salient; smallest to largest as 1 to params.variation.
cv::Mat1f automatic_sizes(const ImageView& photo, const Params& params, const Torus& torus, cv::Size nodes,
                          double step) {
  cv::Mat1f detail = params.sizes_by == SizesBy::kSaliency
                         ? means_at(torus.repeated(salience(photo.mat(), !torus.wraps())), nodes, step)
                         : means_at(torus.repeated(steepness(photo.mat())), nodes, step);
  smooth(detail, 4);
  double mean = 0;
  for (const float v : detail) mean += v;
  mean = mean / static_cast<double>(detail.total()) + 0.5;
  const double widest = std::sqrt(params.variation);
  cv::Mat1f sizes(nodes);
  for (int j = 0; j < nodes.height; ++j)
    for (int i = 0; i < nodes.width; ++i)
      sizes(j, i) =
          static_cast<float>(std::clamp(std::sqrt(1.1 * mean / (detail(j, i) + 0.1 * mean)), 1 / widest, widest));
  smooth(sizes, 6);
  return sizes;
}

cv::Mat1f sizes_of(const Pictures& pictures, const Params& params, const Torus& torus, cv::Size nodes, double step) {
  if (pictures.regions.pixels) {
    cv::Mat1f sizes =
        region_sizes(torus.repeated(fitted(pictures.regions, torus.period)), params.region_sizes, nodes, step);
    smooth(sizes, 2);
    return sizes;
  }
  if (params.variation == 1) return {nodes, 1.0f};
  return automatic_sizes(pictures.photo, params, torus, nodes, step);
}

}  // namespace

double Fields::side(double x, double y) const {
  const double u = std::clamp(x / step, 0.0, sides.cols - 1.001), v = std::clamp(y / step, 0.0, sides.rows - 1.001);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const double s = u - i, t = v - j;
  return (1 - t) * ((1 - s) * sides(j, i) + s * sides(j, i + 1)) +
         t * ((1 - s) * sides(j + 1, i) + s * sides(j + 1, i + 1));
}

cv::Mat1f Fields::sides_within() const {
  if (!torus.wraps()) return sides;
  const auto node = [&](int pixel) { return static_cast<int>(std::lround(pixel / step)); };
  const cv::Rect window = torus.window();
  return sides({node(window.y), std::max(node(window.y) + 1, node(window.br().y))},
               {node(window.x), std::max(node(window.x) + 1, node(window.br().x))});
}

Point Fields::inside(Point p) const {
  return {std::clamp<double>(p.x, 0, size.width), std::clamp<double>(p.y, 0, size.height)};
}

Point Fields::uphill(Point p) const { return uphill_of(distance, p); }

Point Fields::uphill_of(const DistanceField& field, Point p) const {
  const cv::Vec2d up = tessera::uphill(field, p.x, p.y, std::max(2, static_cast<int>(side(p.x, p.y) / 6)));
  return {up[0], up[1]};
}

void scale_sides(Fields& fields, double factor) {
  for (float& v : fields.sides) v = static_cast<float>(std::max(kSmallestSide, v * factor));
}

namespace {

// The margin has room for what the largest tiles may see of each other, and no more of the photo than once again.
Torus torus_of(const Pictures& pictures, const Params& params, double side) {
  Torus torus{{pictures.photo.width, pictures.photo.height}};
  if (!params.seamless) return torus;
  double ratio = params.variation;  // of the largest tile's side to the smallest's
  std::vector<RegionSize> regions;
  if (pictures.regions.pixels && parse_region_sizes(params.region_sizes, regions)) {
    const auto [least, most] = std::minmax_element(
        regions.begin(), regions.end(), [](const RegionSize& a, const RegionSize& b) { return a.size < b.size; });
    ratio = most->size / least->size;
  }
  const double stretch = std::sqrt(std::max(params.aspect, 1 / params.aspect));
  const int wanted = static_cast<int>(std::ceil(kMarginSides * side * stretch * std::sqrt(ratio)));
  torus.margin = std::clamp(wanted, 1, std::max(torus.period.width, torus.period.height));
  return torus;
}

}  // namespace

Fields make_fields(const Pictures& pictures, const Params& params, double side, Rasterizer* rasterizer) {
  Fields fields;
  fields.torus = torus_of(pictures, params, side);
  fields.size = fields.torus.canvas();
  find_edges_and_lines(pictures, params, side, rasterizer, fields);
  fields.step = std::max(1.0, side / kNodesPerSide);
  const cv::Size nodes = DirectionField(fields.size, fields.step).nodes().size();
  fields.sides = sizes_of(pictures, params, fields.torus, nodes, fields.step);
  // As many tiles fit as squares of the average side would: the mean of 1 / side^2 is what counts.
  double tiles = 0;
  const cv::Mat1f within = fields.sides_within();
  for (const float v : within) tiles += 1.0 / (static_cast<double>(v) * v);
  scale_sides(fields, side * std::sqrt(tiles / static_cast<double>(within.total())));
  fields.direction = pictures.direction.pixels ? given_direction(pictures.direction, fields.torus, fields.step)
                                               : direction_of(fields, params, fields.step);
  return fields;
}

}  // namespace tessera::mosaic

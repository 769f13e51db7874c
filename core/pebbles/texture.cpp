#include "tessera/pebbles/texture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

namespace tessera::pebbles {
namespace {

constexpr double kRim = 1;         // px: pixels of an outline are half ground
constexpr int kFlank = 3;          // px around a pebble
constexpr double kFullShade = 48;  // levels of brightness that stand out by the whole height

cv::Mat3b pixels_of(Texture& texture) {
  return {texture.height, texture.width, reinterpret_cast<cv::Vec3b*>(texture.rgb.data())};
}

Texture empty_texture(cv::Size size) {
  Texture texture{size.width, size.height, {}};
  texture.rgb.resize(3 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  return texture;
}

// ---- Pebbles' colours over the ground

bool within(const cv::Mat1i& labels, int x, int y) {
  const int label = labels(y, x);
  return labels(y, std::max(0, x - 1)) == label && labels(y, std::min(labels.cols - 1, x + 1)) == label &&
         labels(std::max(0, y - 1), x) == label && labels(std::min(labels.rows - 1, y + 1), x) == label;
}

// 0 where a pixel is a pebble's and not on its rim, or the pebble is nothing but rim.
cv::Mat1b colours_to_spread(const cv::Mat1i& labels) {
  cv::Mat1b spread(labels.size());
  cv::parallel_for_({0, labels.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < labels.cols; ++x) spread(y, x) = labels(y, x) > 0 && within(labels, x, y) ? 0 : 255;
  });
  double most = 0;
  cv::minMaxIdx(labels, nullptr, &most);
  std::vector<char> only_rim(static_cast<std::size_t>(most) + 1, 1);
  const auto each = [&](const auto& visit) {
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x)
        if (const int label = labels(y, x); label > 0) visit(spread(y, x), only_rim[static_cast<std::size_t>(label)]);
  };
  each([](std::uint8_t& v, char& rim_only) { rim_only &= v != 0; });
  each([](std::uint8_t& v, char& rim_only) { v = rim_only ? 0 : v; });
  return spread;
}

// ---- The ground under the pebbles

// A picture with holes; alpha 255 where it is known.
using Holed = cv::Mat4b;

// Half the size; a pixel is the mean of what is known of four.
Holed halved(const Holed& fine) {
  Holed coarse((fine.rows + 1) / 2, (fine.cols + 1) / 2);
  cv::parallel_for_({0, coarse.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < coarse.cols; ++x) {
        int sum[3] = {}, known = 0;
        for (int j = 2 * y; j < std::min(2 * y + 2, fine.rows); ++j)
          for (int i = 2 * x; i < std::min(2 * x + 2, fine.cols); ++i)
            if (const cv::Vec4b& v = fine(j, i); v[3]) {
              for (int c = 0; c < 3; ++c) sum[c] += v[c];
              ++known;
            }
        cv::Vec4b& target = coarse(y, x) = {0, 0, 0, 0};
        if (known == 0) continue;
        for (int c = 0; c < 3; ++c) target[c] = static_cast<std::uint8_t>((sum[c] + known / 2) / known);
        target[3] = 255;
      }
  });
  return coarse;
}

// What is unknown of `fine` from `coarse`, which has no holes: 9/16, 3/16, 3/16, 1/16 of the nearest four.
void fill_from(const Holed& coarse, Holed& fine) {
  cv::parallel_for_({0, fine.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < fine.cols; ++x) {
        cv::Vec4b& target = fine(y, x);
        if (target[3]) continue;
        const int i = x / 2, j = y / 2;
        const int beside = std::clamp(x % 2 ? i + 1 : i - 1, 0, coarse.cols - 1);
        const int below = std::clamp(y % 2 ? j + 1 : j - 1, 0, coarse.rows - 1);
        for (int c = 0; c < 3; ++c)
          target[c] = static_cast<std::uint8_t>((9 * coarse(j, i)[c] + 3 * coarse(j, beside)[c] +
                                                 3 * coarse(below, i)[c] + coarse(below, beside)[c] + 8) /
                                                16);
        target[3] = 255;
      }
  });
}

void fill_holes(Holed& picture) {
  if (picture.rows == 1 && picture.cols == 1) {
    if (!picture(0, 0)[3]) picture(0, 0) = {128, 128, 128, 255};
    return;
  }
  Holed coarse = halved(picture);
  fill_holes(coarse);
  fill_from(coarse, picture);
}

}  // namespace

Texture photo_texture(const ImageView& photo) {
  Texture texture = empty_texture({photo.width, photo.height});
  photo.mat().copyTo(pixels_of(texture));
  return texture;
}

Texture pebbles_texture(const ImageView& photo, const cv::Mat1i& labels) {
  Texture texture = photo_texture(photo);
  const cv::Mat1b spread = colours_to_spread(labels);
  std::vector<cv::Point> sources;  // numbered as distanceTransform numbers the zeros, from 1
  sources.reserve(spread.total() - static_cast<std::size_t>(cv::countNonZero(spread)));
  for (int y = 0; y < spread.rows; ++y)
    for (int x = 0; x < spread.cols; ++x)
      if (spread(y, x) == 0) sources.emplace_back(x, y);
  if (sources.empty()) return texture;

  cv::Mat1f distance;
  cv::Mat1i nearest;
  cv::distanceTransform(spread, distance, nearest, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  cv::Mat3b pixels = pixels_of(texture);
  const cv::Mat3b colours = photo.mat();
  cv::parallel_for_({0, labels.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < labels.cols; ++x)
        if (labels(y, x) == 0) pixels(y, x) = colours(sources[static_cast<std::size_t>(nearest(y, x) - 1)]);
  });
  return texture;
}

Texture ground_texture(const ImageView& photo, const cv::Mat1i& labels) {
  // Beside a pebble the photo shows its flank and its shadow rather than the ground.
  cv::Mat1b covered = labels > 0, wider;
  cv::dilate(covered, wider, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kFlank + 1, 2 * kFlank + 1}));
  if (cv::countNonZero(wider) < static_cast<int>(wider.total())) covered = wider;

  Holed picture(labels.size());
  const cv::Mat3b pixels = photo.mat();
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const cv::Vec3b& v = pixels(y, x);
      picture(y, x) = {v[0], v[1], v[2], static_cast<std::uint8_t>(255 - covered(y, x))};
    }
  fill_holes(picture);
  Texture texture = empty_texture(labels.size());
  cv::cvtColor(picture, pixels_of(texture), cv::COLOR_RGBA2RGB);
  return texture;
}

Shading::Shading(const Texture& texture) {
  cv::Mat1b brightness(texture.height, texture.width);
  const std::uint8_t* pixel = texture.rgb.data();
  for (std::uint8_t& v : brightness) {
    v = static_cast<std::uint8_t>((299 * pixel[0] + 587 * pixel[1] + 114 * pixel[2] + 500) / 1000);
    pixel += 3;
  }
  cv::integral(brightness, sums_, CV_64F);
}

double Shading::mean(Point place, double radius) const {
  const auto corner = [](double v, int end) { return std::clamp(static_cast<int>(std::floor(v)), 0, end); };
  const int left = corner(place.x - radius, sums_.cols - 2), top = corner(place.y - radius, sums_.rows - 2);
  const int right = std::max(left + 1, corner(place.x + radius + 1, sums_.cols - 1));
  const int bottom = std::max(top + 1, corner(place.y + radius + 1, sums_.rows - 1));
  const double sum = sums_(bottom, right) - sums_(bottom, left) - sums_(top, right) + sums_(top, left);
  return sum / (static_cast<double>(right - left) * (bottom - top));
}

double Shading::height(Point place, double least, double most) const {
  const double brighter = mean(place, least) - mean(place, most);
  return std::clamp(brighter / kFullShade, -1.0, 1.0);
}

Texture normals_texture(const Shading& shading, const cv::Mat1i& labels, const std::vector<Bumps>& bumps) {
  const auto bumps_at = [&](int x, int y) { return bumps[static_cast<std::size_t>(labels(y, x))]; };
  cv::Mat1f heights(labels.size(), 0.0f);
  cv::parallel_for_({0, labels.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < labels.cols; ++x)
        if (labels(y, x) > 0) heights(y, x) = static_cast<float>(bumps_at(x, y).at({x + 0.5, y + 0.5}, shading));
  });
  // Across a pebble's border there is no slope.
  const auto slope = [&](int x, int y, int dx, int dy) {
    const auto inside = [&](int i, int j) {
      return i >= 0 && j >= 0 && i < labels.cols && j < labels.rows && labels(j, i) == labels(y, x);
    };
    const float here = heights(y, x);
    return ((inside(x + dx, y + dy) ? heights(y + dy, x + dx) : here) -
            (inside(x - dx, y - dy) ? heights(y - dy, x - dx) : here)) /
           2;
  };
  Texture texture = empty_texture(labels.size());
  cv::Mat3b pixels = pixels_of(texture);
  cv::parallel_for_({0, labels.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < labels.cols; ++x) {
        const glm::dvec3 n(-slope(x, y, 1, 0), slope(x, y, 0, 1), 1);
        const double scale = 127 / std::sqrt(glm::dot(n, n));
        for (int c = 0; c < 3; ++c)
          pixels(y, x)[c] = static_cast<std::uint8_t>(std::lround(128 + std::min(127.0, scale * n[c])));
      }
  });
  return texture;
}

void project_texture(Mesh& mesh, Point centre, const std::vector<double>& radii, cv::Size photo) {
  const std::size_t n = radii.size();
  mesh.texture_coordinates.resize(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Point from_centre{mesh.positions[v].x, mesh.positions[v].z};
    const double radius = radii[(v + n - 1) % n], most = radius - std::min(kRim, radius / 4);
    if (const double away = length(from_centre); away > most) from_centre = (most / away) * from_centre;
    const Point place = centre + from_centre;
    mesh.texture_coordinates[v] = {std::clamp(place.x / photo.width, 0.0, 1.0),
                                   std::clamp(place.y / photo.height, 0.0, 1.0)};
  }
}

void add_tangents(Mesh& mesh) {
  mesh.tangents.clear();
  for (const glm::vec3& normal : mesh.normals) {
    const glm::dvec3 n(normal);
    glm::dvec3 t = glm::dvec3(1, 0, 0) - n.x * n;
    double size = std::sqrt(glm::dot(t, t));
    if (size < 1e-4) {  // a wall that faces along x: over its rim, x goes on downwards
      t = {0, n.x > 0 ? -1 : 1, 0};
      size = 1;
    }
    mesh.tangents.emplace_back(glm::vec3(t / size), n.y >= 0 ? 1.0f : -1.0f);
  }
}

}  // namespace tessera::pebbles

// Section 3.3: what the meshes show. The photo from above on both halves of each pebble.
#pragma once

#include <glm/vec2.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/mesh.h"
#include "tessera/geometry/scene.h"
#include "tessera/image/image_view.h"
#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

// Labels are of the photo's size: 0 the ground, else Pebble::id.

// The photo as it is.
Texture photo_texture(const ImageView& photo);

// The photo, its ground covered with the colours of the nearest pebbles, taken from within their rims: smaller levels
// of the texture mix no gaps into the pebbles.
Texture pebbles_texture(const ImageView& photo, const cv::Mat1i& labels);

// The photo without its pebbles: their places are filled from the ground around, smoothly.
Texture ground_texture(const ImageView& photo, const cv::Mat1i& labels);

// How much brighter a place of the photo is than what lies around: a guess of how far it stands out.
class Shading {
 public:
  Shading() = default;
  explicit Shading(const Texture& texture);
  // -1..1 at a place in pixels: the mean within `least` px against that within `most` px, squares of twice that side.
  double height(Point place, double least, double most) const;

 private:
  double mean(Point place, double radius) const;
  cv::Mat1d sums_;  // of brightness, above and left of each corner of the pixels
};

// Bumps of a pebble, in px: sizes of shading from `least` to `most` are bumps, shading of 1 stands out by `height`.
struct Bumps {
  double least = 1, most = 1, height = 0;
  double at(Point place, const Shading& shading) const { return height * shading.height(place, least, most); }
};

// Normals in tangent space (x right, y up the picture, z out of it) of the bumps; `bumps` by label.
Texture normals_texture(const Shading& shading, const cv::Mat1i& labels, const std::vector<Bumps>& bumps);

// Texture coordinates of a body's mesh (body_mesh) around `centre`, by projection along y; both halves have the same.
// Vertices near the outline `radii` take their colour from a little way inside it.
void project_texture(Mesh& mesh, Point centre, const std::vector<double>& radii, cv::Size photo);

// Tangents of a mesh that project_texture has dressed: how x goes on over its surface.
void add_tangents(Mesh& mesh);

}  // namespace tessera::pebbles

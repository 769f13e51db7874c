#include "tessera/geometry/extrude.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "tessera/geometry/triangulate.h"

namespace tessera {
namespace {

constexpr double kLeast = 1e-3;  // px; vertices nearer to each other, or to their neighbours' line, are left out
constexpr double kRoughness = 0.6;

// Whether a ring is the same, as far as can be seen, without `b` between `a` and `c`.
bool is_idle(Point a, Point b, Point c) {
  const Point way = c - a;
  const double across = std::fabs(cross(way, b - a));
  return length(b - a) < kLeast || across <= kLeast * length(way);
}

// Clockwise on the screen where `sense` is 1; without idle vertices, which would make triangles without area.
Ring cleaned(Ring ring, int sense) {
  for (std::size_t k = 0; k < ring.size() && ring.size() >= 3;) {
    const Point a = ring[k > 0 ? k - 1 : ring.size() - 1], c = ring[k + 1 < ring.size() ? k + 1 : 0];
    if (is_idle(a, ring[k], c)) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
      if (k > 0) --k;
    } else {
      ++k;
    }
  }
  if (ring.size() < 3) return {};
  if (signed_area(ring) * sense < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

Polygon cleaned(const Polygon& polygon) {
  Polygon result{cleaned(polygon.outer, 1), {}};
  for (const Ring& hole : polygon.holes)
    if (Ring ring = cleaned(hole, -1); !ring.empty()) result.holes.push_back(std::move(ring));
  return result;
}

// Slabs that become one mesh. Hard edges: each face has vertices of its own.
class Slabs {
 public:
  explicit Slabs(const PieceSheet& sheet)
      : middle_{sheet.width / 2, sheet.height / 2},
        metres_(sheet.width_mm > 0 ? sheet.width_mm / 1000 / sheet.width : 0.001) {}

  // Heights and bevel in px.
  void add(const Polygon& outline, double bottom, double top, double bevel, Rgb colour) {
    const Polygon foot = cleaned(outline);
    if (foot.outer.empty()) return;
    Polygon head = foot;
    if (foot.holes.empty()) head.outer = inset(foot.outer, bevel);
    const bool bevelled = !(head.outer == foot.outer);
    const double shoulder = bevelled ? top - bevel : top;
    const std::size_t first = mesh_.positions.size();
    add_cap(foot, bottom, -1);
    add_band(foot.outer, bottom, foot.outer, shoulder);
    for (const Ring& hole : foot.holes) add_band(hole, bottom, hole, shoulder);
    if (bevelled) add_band(foot.outer, shoulder, head.outer, top);
    add_cap(head, top, 1);
    mesh_.colours.resize(mesh_.colours.size() + mesh_.positions.size() - first, colour);
  }

  void move_to(Scene& scene, const std::string& name) && {
    if (mesh_.positions.empty()) return;
    mesh_.indices = std::make_shared<const std::vector<std::uint32_t>>(std::move(indices_));
    mesh_.surface = 0;
    SceneNode node;
    node.name = name;
    node.mesh = static_cast<int>(scene.meshes.size());
    scene.views.front().nodes.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back(std::move(node));
    scene.meshes.push_back(std::move(mesh_));
  }

 private:
  glm::dvec3 place(Point p, double height) const {
    return metres_ * glm::dvec3(p.x - middle_.x, height, p.y - middle_.y);
  }

  std::uint32_t add_vertex(const glm::dvec3& position, const glm::dvec3& normal) {
    mesh_.positions.emplace_back(position);
    mesh_.normals.emplace_back(normal);
    return static_cast<std::uint32_t>(mesh_.positions.size()) - 1;
  }

  // Facing up or down. What is clockwise on the screen is so from above.
  void add_cap(const Polygon& polygon, double height, int up) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (const Point p : polygon.outer) add_vertex(place(p, height), {0, up, 0});
    for (const Ring& hole : polygon.holes)
      for (const Point p : hole) add_vertex(place(p, height), {0, up, 0});
    std::vector<std::uint32_t> triangles = triangulate(polygon);
    if (up > 0) std::reverse(triangles.begin(), triangles.end());
    for (const std::uint32_t vertex : triangles) indices_.push_back(first + vertex);
  }

  // Between rings that have as many vertices: a face for each side.
  void add_band(const Ring& low_ring, double low, const Ring& high_ring, double high) {
    for (std::size_t k = 0; k < low_ring.size(); ++k) {
      const std::size_t next = k + 1 < low_ring.size() ? k + 1 : 0;
      const glm::dvec3 corners[] = {place(low_ring[k], low), place(high_ring[k], high), place(high_ring[next], high),
                                    place(low_ring[next], low)};
      const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
      std::uint32_t at[4];
      for (int c = 0; c < 4; ++c) at[c] = add_vertex(corners[c], normal);
      indices_.insert(indices_.end(), {at[0], at[1], at[2], at[0], at[2], at[3]});
    }
  }

  Point middle_;
  double metres_;  // a pixel
  Mesh mesh_;
  std::vector<std::uint32_t> indices_;
};

// The side of a square of the pieces' mean area, px.
double mean_size(const PieceSheet& sheet) {
  double sum = 0;
  for (const Piece& piece : sheet.pieces) sum += area(piece.outline);
  return sum > 0 ? std::sqrt(sum / static_cast<double>(sheet.pieces.size())) : 1;
}

}  // namespace

Scene extruded(const PieceSheet& sheet) {
  const double size = mean_size(sheet), bed = kSlabs.bed * size, bottom = bed - kSlabs.sunk * size;
  Slabs pieces(sheet), grout(sheet);
  for (const Piece& piece : sheet.pieces)
    pieces.add(piece.outline, bottom, bottom + kSlabs.thickness * size, kSlabs.bevel * size, piece.fill);
  grout.add({{{0, 0}, {sheet.width, 0}, {sheet.width, sheet.height}, {0, sheet.height}}, {}}, 0, bed, 0, sheet.grout);

  Scene scene;
  scene.job_json = sheet.job_json;
  scene.surfaces.push_back({.name = sheet.layer, .roughness = kRoughness});
  scene.views.push_back({sheet.layer, {}});
  std::move(pieces).move_to(scene, sheet.layer);
  std::move(grout).move_to(scene, "grout");
  return scene;
}

}  // namespace tessera

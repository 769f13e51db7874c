// Draws flat content with OpenGL ES 3.0.
#pragma once

#include <memory>
#include <optional>

#include "tessera/base/status.h"
#include "tessera/gpu/gl_object.h"
#include "tessera/view/content.h"

namespace tessera::view {

// Lives and dies with its context current.
class FlatPainter {
 public:
  static Result<FlatPainter> create();

  void show(std::shared_ptr<const Flat> flat);
  // Pieces are drawn anew for where the camera is if `sharply`; else what was drawn of them before is moved there.
  void draw(const FlatCamera& camera, bool sharply);
  // Whether another draw() with `sharply` would look better than the last one.
  bool is_blurred() const { return blurred_; }

 private:
  // A picture on the card, and where it lies in the content's coordinates.
  struct Tile {
    gl::Texture texture;
    Point corner;
    Size size;
  };
  explicit FlatPainter(gl::Program program) : program_(std::move(program)) {}
  void draw_part(const PieceSheet& sheet, const FlatCamera& camera);

  gl::Program program_;
  gl::VertexArray none_;
  std::shared_ptr<const Flat> flat_;
  std::optional<Tile> tile_;
  bool blurred_ = false;
};

}  // namespace tessera::view

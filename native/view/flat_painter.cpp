#include "tessera/view/flat_painter.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "shaders.h"
#include "tessera/base/colour.h"
#include "tessera/formats/formats.h"
#include "tessera/view/texture.h"

namespace tessera::view {
namespace {

// Three bytes a pixel, over white.
cv::Mat3b colours_of(const Raster& raster) {
  const std::ptrdiff_t bytes = raster.bits / 8, channels = raster.channels;
  cv::Mat3b colours(raster.height, raster.width);
  const std::uint8_t* from = raster.bytes.data();
  for (cv::Vec3b& to : colours) {
    const int opacity = channels % 2 == 0 ? from[(channels - 1) * bytes] : 255;
    for (int c = 0; c < 3; ++c) to[c] = over_white(from[channels < 3 ? 0 : c * bytes], opacity);
    from += channels * bytes;
  }
  return colours;
}

// The pixels of the sheet, drawn at the camera's scale, that are in the window.
PicturePart visible_part(const FlatCamera& camera) {
  const auto whole = [](double v) { return static_cast<int>(std::lround(v)); };
  const int width = std::max(1, whole(camera.scale() * camera.content().width));
  const int height = std::max(1, whole(camera.scale() * camera.content().height));
  const int left = std::clamp(-whole(camera.corner().x), 0, width - 1);
  const int top = std::clamp(-whole(camera.corner().y), 0, height - 1);
  const int right = std::clamp(whole(camera.window().width - camera.corner().x), left + 1, width);
  const int bottom = std::clamp(whole(camera.window().height - camera.corner().y), top + 1, height);
  return {left, top, right - left, bottom - top};
}

}  // namespace

Result<FlatPainter> FlatPainter::create() {
  auto program = gl::Program::build("placed", shaders::kPlacedVert, shaders::kPlacedFrag);
  if (!program) return tl::unexpected<Status>(std::move(program.error()));
  return FlatPainter(*std::move(program));
}

void FlatPainter::show(std::shared_ptr<const Flat> flat) {
  flat_ = std::move(flat);
  tile_.reset();
  const Raster* raster = std::get_if<Raster>(&flat_->made);
  if (!raster) return;
  tile_.emplace(Tile{{}, {0, 0}, flat_->size});
  upload(colours_of(*raster), {.larger = GL_NEAREST}, tile_->texture);
}

void FlatPainter::draw_part(const PieceSheet& sheet, const FlatCamera& camera) {
  const PicturePart part = visible_part(camera);
  const double scale = camera.scale();
  tile_.emplace(Tile{{}, {part.left / scale, part.top / scale}, {part.width / scale, part.height / scale}});
  upload(colours_of(draw_sheet(sheet, scale, part)), {.smaller = GL_LINEAR}, tile_->texture);
}

void FlatPainter::draw(const FlatCamera& camera, bool sharply) {
  if (!flat_) return;
  const PieceSheet* sheet = std::get_if<PieceSheet>(&flat_->made);
  if (sheet && (sharply || !tile_)) draw_part(*sheet, camera);
  blurred_ = sheet && !sharply;
  const Point corner = camera.to_window(tile_->corner);
  const Point size = camera.scale() * Point{tile_->size.width, tile_->size.height};
  const auto x = [&](double at) { return static_cast<float>(2 * at / camera.window().width - 1); };
  const auto y = [&](double at) { return static_cast<float>(1 - 2 * at / camera.window().height); };
  glDisable(GL_DEPTH_TEST);
  program_.use();
  glBindVertexArray(none_.id());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, tile_->texture.id());
  glUniform1i(program_.uniform("picture"), 0);
  glUniform4f(program_.uniform("place"), x(corner.x), y(corner.y), x(corner.x + size.x), y(corner.y + size.y));
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace tessera::view

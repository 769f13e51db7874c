// Pictures on the graphics card.
#pragma once

#include <opencv2/core.hpp>

#include "tessera/gpu/gl_object.h"

namespace tessera::view {

struct Sampling {
  GLint smaller = GL_LINEAR_MIPMAP_LINEAR;
  GLint larger = GL_LINEAR;
  GLint wrap = GL_CLAMP_TO_EDGE;
};

// Makes the picture, R G B, the texture's; less fine where the card takes none as large.
void upload(const cv::Mat3b& picture, const Sampling& sampling, const gl::Texture& texture);

}  // namespace tessera::view

#include "tessera/view/texture.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace tessera::view {
namespace {

cv::Mat3b as_large_as_possible(const cv::Mat3b& picture) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  const double ratio = static_cast<double>(most) / std::max(picture.cols, picture.rows);
  if (ratio >= 1) return picture;
  const auto reduced = [&](int length) { return std::clamp(static_cast<int>(length * ratio), 1, most); };
  cv::Mat3b smaller;
  cv::resize(picture, smaller, {reduced(picture.cols), reduced(picture.rows)}, 0, 0, cv::INTER_AREA);
  return smaller;
}

}  // namespace

void upload(const cv::Mat3b& picture, const Sampling& sampling, const gl::Texture& texture) {
  const cv::Mat3b fitting = as_large_as_possible(picture);
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, fitting.cols, fitting.rows, 0, GL_RGB, GL_UNSIGNED_BYTE, fitting.ptr());
  if (sampling.smaller == GL_LINEAR_MIPMAP_LINEAR) glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, sampling.smaller);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sampling.larger);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, sampling.wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, sampling.wrap);
}

}  // namespace tessera::view

// Pictures made in code, as the core takes them.
#pragma once

#include <opencv2/core.hpp>

#include "tessera/image/image_view.h"

namespace tessera {

inline ImageView view_of(const cv::Mat3b& picture) {
  return {picture.ptr(), picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
}

}  // namespace tessera

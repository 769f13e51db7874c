// What fuzz targets share: bytes as the core wants them, and how a broken promise is told.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>

#include "tessera/base/status.h"
#include "tessera/image/image_view.h"

namespace tessera::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// libFuzzer keeps the input of a program that aborts.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

// A reason is one line that a person can read.
inline void require_message(const Status& status) {
  require(!status.message.empty(), "a reason says something");
  require(status.message.find('\n') == std::string::npos, "a reason is one line");
  require(status.code != StatusCode::kInternal, "bad input is no fault of ours");
}
inline void require_messages(const Problems& problems) {
  require(!problems.empty(), "there is a reason");
  for (const Status& status : problems) require_message(status);
}

// A small picture of few colours: a byte of the input a pixel while there are some, then stripes.
inline cv::Mat3b picture_from(FuzzedDataProvider& data, int longest) {
  const int width = data.ConsumeIntegralInRange(1, longest), height = data.ConsumeIntegralInRange(1, longest);
  const int period = data.ConsumeIntegralInRange(1, longest);
  const std::string pixels = data.ConsumeBytesAsString(static_cast<std::size_t>(data.ConsumeIntegralInRange(0, 64)));
  cv::Mat3b picture(height, width);
  std::size_t next = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool given = next < pixels.size();
      const auto value = given ? static_cast<std::uint8_t>(pixels[next++])
                               : static_cast<std::uint8_t>((x + y) / period % 2 == 0 ? 255 : 0);
      // Three bits red, three green, two blue.
      picture(y, x) = {static_cast<std::uint8_t>((value >> 5) * 36), static_cast<std::uint8_t>((value >> 2 & 7) * 36),
                       static_cast<std::uint8_t>((value & 3) * 85)};
    }
  return picture;
}

inline ImageView view_of(const cv::Mat3b& picture) {
  return {picture.ptr(), picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
}

}  // namespace tessera::fuzz

// libFuzzer calls it before the first input. A target is one file, so that it is defined once.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  cv::setNumThreads(1);
  return 0;
}

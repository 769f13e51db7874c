// Where exceptions of others end.
#pragma once

#include <fmt/format.h>

#include <new>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "tessera/base/status.h"

namespace tessera {

inline constexpr const char* kOutOfMemory = "out of memory; smaller pictures and fewer pieces take less";

// What `work` returns, a Result; OpenCV's exceptions and failed allocations become problems.
template <class Work>
auto guarded(const Work& work) -> tl::expected<typename decltype(work())::value_type, Problems> {
  const auto fault = [](std::string message) {
    return tl::unexpected<Problems>(Problems{{StatusCode::kInternal, "", std::move(message)}});
  };
  try {
    auto result = work();
    if (result) return *std::move(result);
    return tl::unexpected<Problems>(Problems{std::move(result.error())});
  } catch (const std::bad_alloc&) {
    return fault(kOutOfMemory);
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) return fault(kOutOfMemory);
    return fault(fmt::format("OpenCV failed in {}: {}", error.func, error.err));
  }
}

}  // namespace tessera

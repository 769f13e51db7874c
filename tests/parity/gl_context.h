// An OpenGL ES context for the tests: EGL's natively; a worker's OffscreenCanvas in the browser.
#pragma once

#ifndef __EMSCRIPTEN__

#include "tessera/egl/egl_context.h"

namespace tessera {
using GlContext = EglContext;
}

#else

#include <emscripten/html5.h>

#include <string>
#include <utility>

#include "tessera/base/status.h"

namespace tessera {

class GlContext {
 public:
  static Result<GlContext> create();

  ~GlContext();
  GlContext(GlContext&& other) noexcept
      : handle_(std::exchange(other.handle_, 0)), renderer_(std::move(other.renderer_)) {}
  GlContext& operator=(GlContext&&) = delete;

  Result<void> make_current();
  // As the browser takes it away at any time.
  void lose();
  const std::string& renderer() const { return renderer_; }

 private:
  GlContext() = default;

  EMSCRIPTEN_WEBGL_CONTEXT_HANDLE handle_ = 0;
  std::string renderer_;
};

}  // namespace tessera

#endif

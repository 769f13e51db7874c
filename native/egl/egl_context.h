// An OpenGL ES 3.0 context without a window or screen.
#pragma once

#include <string>
#include <utility>

#include "tessera/base/status.h"

namespace tessera {

// Owns the context; movable. It may be current on one thread at a time.
class EglContext {
 public:
  // Tries Mesa without a surface, each graphics device, then the default display, and takes the first that is
  // graphics hardware, else the first that works at all. The context is current on the calling thread. kInternal,
  // with what each answered, where there is none.
  static Result<EglContext> create();

  // Releases it on the calling thread, if it is current there, and destroys it.
  ~EglContext();
  EglContext(EglContext&& other) noexcept
      : display_(std::exchange(other.display_, nullptr)),
        context_(std::exchange(other.context_, nullptr)),
        surface_(std::exchange(other.surface_, nullptr)),
        renderer_(std::move(other.renderer_)) {}
  EglContext& operator=(EglContext&&) = delete;

  Result<void> make_current();
  void release();

  // What GL calls its renderer: "llvmpipe (LLVM 15.0.6, 256 bits)".
  const std::string& renderer() const { return renderer_; }
  // Whether GL is drawn by the processor, where the CPU backend is faster.
  bool is_software() const;

 private:
  EglContext() = default;
  static Result<EglContext> open(void* display);

  // EGLDisplay, EGLContext, EGLSurface, without EGL's headers, which define words that others use.
  void* display_ = nullptr;
  void* context_ = nullptr;
  void* surface_ = nullptr;
  std::string renderer_;
};

}  // namespace tessera

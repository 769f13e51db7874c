#include "tessera/cli/backend.h"

#include <filesystem>
#include <utility>

#include "tessera/gpu/gl_rasterizer.h"
#include "tessera/voronoi/cpu_rasterizer.h"
#include "tessera/voronoi/fallback_rasterizer.h"

namespace tessera {
namespace {

// Asked before EGL, since loading a driver only to learn that it draws in software costs more than a small job.
bool may_have_graphics_hardware() {
  for (const char* device : {"/dev/dri", "/dev/nvidiactl", "/dev/dxg", "/dev/mali0", "/dev/kgsl-3d0"}) {
    std::error_code error;
    if (std::filesystem::exists(device, error)) return true;
  }
  return false;
}

Result<Backend> gl_backend(EglContext context) {
  auto rasterizer = make_gl_rasterizer();
  if (!rasterizer) return tl::unexpected<Status>(std::move(rasterizer.error()));
  return Backend{std::move(context), *std::move(rasterizer)};
}

Backend best_backend() {
  if (!may_have_graphics_hardware()) return cpu_backend();
  auto context = EglContext::create();
  if (!context || context->is_software()) return cpu_backend();
  auto backend = gl_backend(*std::move(context));
  return backend ? *std::move(backend) : cpu_backend();
}

}  // namespace

Backend cpu_backend() { return {std::nullopt, make_cpu_rasterizer()}; }

Result<Backend> make_backend(BackendChoice choice) {
  if (choice == BackendChoice::kCpu) return cpu_backend();
  if (choice == BackendChoice::kAuto) return best_backend();
  auto backend = EglContext::create().and_then(gl_backend);
  if (backend) return backend;
  return fail(StatusCode::kInvalidParameter, "backend",
              "gl does not work here (" + backend.error().message + "), expected auto or cpu");
}

void let_cpu_take_over(Backend& backend, std::function<void(const std::string& message)> warn) {
  backend.rasterizer = make_fallback_rasterizer(
      std::move(backend.rasterizer), cpu_backend().rasterizer, [warn = std::move(warn)](const Status& reason) {
        warn("the gl backend failed (" + reason.message + "), the cpu takes over");
      });
}

}  // namespace tessera

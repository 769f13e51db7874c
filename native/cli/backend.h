// Which rasterizer a run draws with.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "tessera/base/status.h"
#include "tessera/egl/egl_context.h"
#include "tessera/voronoi/rasterizer.h"

namespace tessera {

enum class BackendChoice { kAuto, kCpu, kGl };

struct Backend {
  std::optional<EglContext> context;  // outlives the rasterizer that draws with it
  std::unique_ptr<Rasterizer> rasterizer;
};

Backend cpu_backend();
// kAuto takes GL on graphics hardware and the CPU elsewhere; it never fails. kGl is kInvalidParameter where there is
// no GL at all.
Result<Backend> make_backend(BackendChoice choice);
// From here on the CPU takes over where GL fails on the way, and `warn` is told.
void let_cpu_take_over(Backend& backend, std::function<void(const std::string& message)> warn);

}  // namespace tessera

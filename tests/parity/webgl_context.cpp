#ifdef __EMSCRIPTEN__

#include <GLES3/gl3.h>
#include <emscripten.h>

#include "gl_context.h"

namespace tessera {
namespace {

// clang-format off
EM_JS(int, open_context, (), {
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
  return gl ? GL.registerContext(gl, {majorVersion: 2}) : 0;
});
EM_JS(void, lose_context, (int handle), {
  GL.getContext(handle).GLctx.getExtension('WEBGL_lose_context').loseContext();
});
EM_JS(void, close_context, (int handle), { GL.deleteContext(handle); });
// clang-format on

}  // namespace

Result<GlContext> GlContext::create() {
  GlContext context;
  context.handle_ = open_context();
  if (!context.handle_) return fail(StatusCode::kInternal, "", "there is no WebGL2");
  if (auto current = context.make_current(); !current) return tl::unexpected<Status>(std::move(current.error()));
  context.renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return context;
}

GlContext::~GlContext() {
  if (handle_) close_context(handle_);
}

Result<void> GlContext::make_current() {
  if (emscripten_webgl_make_context_current(handle_) == EMSCRIPTEN_RESULT_SUCCESS) return {};
  return fail(StatusCode::kInternal, "", "the WebGL2 context cannot be made current");
}

void GlContext::lose() { lose_context(handle_); }

}  // namespace tessera

#endif

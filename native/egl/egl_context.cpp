#include "tessera/egl/egl_context.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

namespace tessera {
namespace {

tl::unexpected<Status> failure(const std::string& what) {
  char code[16];
  std::snprintf(code, sizeof code, "0x%04x", static_cast<unsigned>(eglGetError()));
  return fail(StatusCode::kInternal, "", what + " (EGL " + code + ")");
}

// Whether the word `name` is in the list.
bool lists(const char* extensions, std::string_view name) {
  if (extensions == nullptr) return false;
  return (' ' + std::string(extensions) + ' ').find(' ' + std::string(name) + ' ') != std::string::npos;
}

template <class Function>
Function function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<EGLDeviceEXT> devices() {
  const auto query = function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  EGLint count = 0;
  if (query == nullptr || query(0, nullptr, &count) != EGL_TRUE) return {};
  std::vector<EGLDeviceEXT> found(count);
  if (query(count, found.data(), &count) != EGL_TRUE) return {};
  found.resize(count);
  return found;
}

// A way to a display, tried in turn.
struct Candidate {
  std::string name;
  EGLDisplay display;
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> found;
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto platform_display = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (platform_display != nullptr && lists(extensions, "EGL_MESA_platform_surfaceless"))
    found.push_back({"surfaceless", platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});
  if (platform_display != nullptr && lists(extensions, "EGL_EXT_platform_device")) {
    int number = 0;
    for (EGLDeviceEXT device : devices())
      found.push_back(
          {"device " + std::to_string(number++), platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr)});
  }
  found.push_back({"default display", eglGetDisplay(EGL_DEFAULT_DISPLAY)});
  return found;
}

}  // namespace

Result<EglContext> EglContext::create() {
  std::optional<EglContext> software;
  std::string answers;
  for (const Candidate& candidate : candidates()) {
    Result<EglContext> context = open(candidate.display);
    if (!context) {
      answers += "; " + candidate.name + ": " + context.error().message;
    } else if (!context->is_software()) {
      return context;
    } else if (!software) {
      software.emplace(std::move(*context));
    }
  }
  if (!software) return fail(StatusCode::kInternal, "", "no OpenGL ES 3.0 context to be had through EGL" + answers);
  if (Result<void> current = software->make_current(); !current) return tl::unexpected(current.error());
  return std::move(*software);
}

// Displays are never terminated: EGL hands out the same one each time, and another context may live on it.
Result<EglContext> EglContext::open(void* display) {
  if (display == EGL_NO_DISPLAY) return failure("no such display");
  if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return failure("cannot be initialised");
  if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) return failure("has no OpenGL ES");
  const bool surfaceless = lists(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");

  const EGLint config_attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE,
                                      surfaceless ? 0 : EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, config_attributes, &config, 1, &count) != EGL_TRUE || count == 0)
    return failure("has no configuration for OpenGL ES 3");

  EglContext result;
  result.display_ = display;
  const EGLint context_attributes[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
  result.context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes);
  if (result.context_ == EGL_NO_CONTEXT) return failure("makes no context");
  if (!surfaceless) {
    const EGLint surface_attributes[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    result.surface_ = eglCreatePbufferSurface(display, config, surface_attributes);
    if (result.surface_ == EGL_NO_SURFACE) return failure("makes no surface");
  }
  if (Result<void> current = result.make_current(); !current) return tl::unexpected(current.error());
  const GLubyte* renderer = glGetString(GL_RENDERER);
  if (renderer == nullptr) return failure("does not name its renderer");
  result.renderer_ = reinterpret_cast<const char*>(renderer);
  return result;
}

EglContext::~EglContext() {
  if (context_ == nullptr) return;
  release();
  eglDestroyContext(display_, context_);
  if (surface_ != nullptr) eglDestroySurface(display_, surface_);
}

Result<void> EglContext::make_current() {
  if (eglMakeCurrent(display_, surface_, surface_, context_) == EGL_TRUE) return {};
  return failure("the context cannot be made current");
}

void EglContext::release() {
  if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

bool EglContext::is_software() const {
  std::string name = renderer_;
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* word : {"llvmpipe", "softpipe", "swiftshader", "swrast", "software"})
    if (name.find(word) != std::string::npos) return true;
  return false;
}

}  // namespace tessera

#include "tessera/view/sdl.h"

#include <dlfcn.h>

#include <string>

namespace tessera::view {

Result<Sdl> Sdl::load() {
  const auto why = [] {
    const char* const reason = dlerror();  // NOLINT(concurrency-mt-unsafe): no other thread loads anything
    return fail(StatusCode::kUnwritable, "", "no window can be opened: " + std::string(reason ? reason : "no SDL2"));
  };
  void* const library = dlopen("libSDL2-2.0.so.0", RTLD_LAZY | RTLD_LOCAL);
  if (!library) return why();
  Sdl sdl;
#define TESSERA_SDL_FIND(name)                                                   \
  sdl.name = reinterpret_cast<decltype(sdl.name)>(dlsym(library, "SDL_" #name)); \
  if (!sdl.name) return why();
  TESSERA_SDL_FUNCTIONS(TESSERA_SDL_FIND)
#undef TESSERA_SDL_FIND
  return sdl;
}

}  // namespace tessera::view

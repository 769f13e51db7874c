// SDL2, loaded when a window is wanted: it brings some fifty shared libraries along, which no other command waits
// for.
#pragma once

#define SDL_MAIN_HANDLED
#include <SDL2/SDL.h>

#include "tessera/base/status.h"

namespace tessera::view {

// clang-format off
#define TESSERA_SDL_FUNCTIONS(X) \
  X(CreateWindow) X(DestroyWindow) X(GL_CreateContext) X(GL_DeleteContext) X(GL_GetDrawableSize) \
  X(GL_SetAttribute) X(GL_SetSwapInterval) X(GL_SwapWindow) X(GetError) X(GetModState) X(GetMouseState) \
  X(GetWindowSize) X(Init) X(PollEvent) X(Quit) X(SetHint) X(SetMainReady) X(SetWindowTitle) \
  X(WaitEventTimeout)
// clang-format on

// `sdl.Init` is SDL_Init.
struct Sdl {
// NOLINTNEXTLINE(bugprone-macro-parentheses): a member is declared without
#define TESSERA_SDL_MEMBER(name) decltype(&::SDL_##name) name = nullptr;
  TESSERA_SDL_FUNCTIONS(TESSERA_SDL_MEMBER)
#undef TESSERA_SDL_MEMBER

  // kUnwritable where there is no such library. It stays loaded until the program ends.
  static Result<Sdl> load();
};

}  // namespace tessera::view

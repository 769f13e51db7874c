// The window: what is shown in it, and what keys and the mouse do to it.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "tessera/base/status.h"
#include "tessera/geometry/raster.h"
#include "tessera/view/feed.h"

namespace tessera::view {

struct WindowOptions {
  std::string title;
  int width = 1280, height = 800;
  bool ends = false;                                        // once the result has been shown, which is then saved
  const std::atomic<int>* stop = nullptr;                   // non-zero ends it, from a signal handler
  std::function<Result<void>(const Raster& picture)> save;  // what is seen
  std::function<void(const std::string& message)> say;      // a line to the user
};

// What keys and the mouse do, a line each.
std::string key_help();

// Opened and run on one thread, the program's first.
class Window {
 public:
  // kUnwritable, and why, where no window can be opened.
  static Result<Window> open(const WindowOptions& options);
  ~Window();
  Window(Window&&) noexcept;
  Window& operator=(Window&&) = delete;

  // Until the user closes it, `stop` is set or the feed fails. Errors are those of saving, where it ends by itself.
  Result<void> run(Feed& feed);

 private:
  class Stage;
  explicit Window(std::unique_ptr<Stage> stage);
  std::unique_ptr<Stage> stage_;
};

}  // namespace tessera::view

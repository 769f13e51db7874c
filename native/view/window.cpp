#include "tessera/view/window.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "tessera/view/flat_painter.h"
#include "tessera/view/orbit_camera.h"
#include "tessera/view/sdl.h"
#include "tessera/view/solid_painter.h"

namespace tessera::view {
namespace {

constexpr int kFrameMs = 15;        // that events are waited for
constexpr double kZoomStep = 1.25;  // of a key or a notch of the wheel
constexpr double kPanStep = 0.125;  // of the window, of an arrow key
constexpr double kTurnStep = M_PI / 24;
constexpr double kTurnOfWindow = M_PI;  // dragging across the window's height
constexpr int kBarHeight = 4;

tl::unexpected<Status> no_window(const std::string& reason) {
  return fail(StatusCode::kUnwritable, "", "no window can be opened: " + reason);
}

void clear(Rgb colour) {
  glClearColor(static_cast<float>(colour.r) / 255, static_cast<float>(colour.g) / 255,
               static_cast<float>(colour.b) / 255, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

// SDL's names of the drivers that reach a screen here: left to itself it goes on without one. Empty: none does.
std::string drivers() {
  const auto is_set = [](const char* name) {  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes it
    const char* const value = std::getenv(name);
    return value && *value;
  };
  if (is_set("WAYLAND_DISPLAY")) return is_set("DISPLAY") ? "wayland,x11" : "wayland";
  return is_set("DISPLAY") ? "x11" : "";
}

// SDL's library, its window and GL's context in it.
class Screen {
 public:
  static Result<std::unique_ptr<Screen>> open(const WindowOptions& options) {
    if (drivers().empty()) return no_window("there is no display, neither DISPLAY nor WAYLAND_DISPLAY is set");
    auto sdl = Sdl::load();
    if (!sdl) return tl::unexpected<Status>(std::move(sdl.error()));
    auto screen = std::unique_ptr<Screen>(new Screen(*sdl));
    sdl->SetMainReady();
    sdl->SetHint(SDL_HINT_VIDEODRIVER, drivers().c_str());
    sdl->SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    sdl->SetHint(SDL_HINT_OPENGL_ES_DRIVER, "1");
    sdl->SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    if (sdl->Init(SDL_INIT_VIDEO) != 0) return no_window(sdl->GetError());
    screen->initialised_ = true;
    for (const auto& [attribute, value] :
         {std::pair{SDL_GL_CONTEXT_PROFILE_MASK, static_cast<int>(SDL_GL_CONTEXT_PROFILE_ES)},
          {SDL_GL_CONTEXT_MAJOR_VERSION, 3},
          {SDL_GL_CONTEXT_MINOR_VERSION, 0},
          {SDL_GL_DEPTH_SIZE, 24}})
      sdl->GL_SetAttribute(attribute, value);
    for (const int samples : {4, 0})  // edges are smooth where the card can
      if (screen->open_window(options, samples)) return screen;
    return no_window(sdl->GetError());
  }

  ~Screen() {
    if (context_) sdl.GL_DeleteContext(context_);
    if (window_) sdl.DestroyWindow(window_);
    if (initialised_) sdl.Quit();
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  Size size() const {
    int width = 1, height = 1;
    sdl.GL_GetDrawableSize(window_, &width, &height);
    return {std::max(1.0, 0.0 + width), std::max(1.0, 0.0 + height)};
  }
  // Pixels to a unit of the mouse's coordinates.
  double density() const {
    int width = 1, height = 1;
    sdl.GetWindowSize(window_, &width, &height);
    return size().width / std::max(1, width);
  }
  void set_title(const std::string& title) { sdl.SetWindowTitle(window_, title.c_str()); }
  void present() { sdl.GL_SwapWindow(window_); }

  Raster picture() const {
    const auto [width, height] = size();
    Raster raster{static_cast<int>(width), static_cast<int>(height), 3, 8, {}};
    std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(raster.width) * raster.height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, raster.width, raster.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    raster.bytes.reserve(rgba.size() / 4 * 3);
    for (int y = raster.height - 1; y >= 0; --y)  // GL's rows go up
      for (int x = 0; x < raster.width; ++x) {
        const std::uint8_t* pixel = &rgba[4 * (static_cast<std::size_t>(y) * raster.width + x)];
        raster.bytes.insert(raster.bytes.end(), pixel, pixel + 3);
      }
    return raster;
  }

  const Sdl sdl;

 private:
  explicit Screen(const Sdl& library) : sdl(library) {}

  bool open_window(const WindowOptions& options, int samples) {
    sdl.GL_SetAttribute(SDL_GL_MULTISAMPLEBUFFERS, samples > 0 ? 1 : 0);
    sdl.GL_SetAttribute(SDL_GL_MULTISAMPLESAMPLES, samples);
    window_ = sdl.CreateWindow(options.title.c_str(), SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, options.width,
                               options.height, SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (!window_) return false;
    context_ = sdl.GL_CreateContext(window_);
    if (context_) {
      sdl.GL_SetSwapInterval(1);
      return true;
    }
    sdl.DestroyWindow(std::exchange(window_, nullptr));
    return false;
  }

  bool initialised_ = false;
  SDL_Window* window_ = nullptr;
  SDL_GLContext context_ = nullptr;
};

}  // namespace

std::string key_help() {
  return "drag          move, in 3D turn (with the right button or Shift: move)\n"
         "wheel, + -    closer and farther\n"
         "arrow keys    move, in 3D turn\n"
         "0             all of it\n"
         "Tab           flat or in 3D\n"
         "s             save what is seen as PNG\n"
         "h             these keys\n"
         "q, Esc        end\n";
}

// All that a window holds; GL's objects go before its context.
class Window::Stage {
 public:
  Stage(const WindowOptions& options, std::unique_ptr<Screen> screen, FlatPainter flat, SolidPainter solid)
      : options_(options),
        screen_(std::move(screen)),
        flat_painter_(std::move(flat)),
        solid_painter_(std::move(solid)) {}

  Result<void> run(Feed& feed) {
    while (!quits_ && !(options_.stop && options_.stop->load() != 0)) {
      const bool moved = handle_events();
      const News news = feed.take();
      if (news.state == News::State::kFailed) return {};
      if (news.content) show(*news.content);
      const bool told = tell(news);
      if (options_.ends && news.state == News::State::kDone) return save();
      // While the camera moves, what was drawn moves with it; pieces are drawn anew when it stands still.
      if (moved || told || news.content || is_blurred()) {
        draw(!moved);
        screen_->present();
      }
    }
    return {};
  }

 private:
  // ---- Content

  void show(const Content& content) {
    content_ = content;
    if (content.flat) {
      flat_painter_.show(content.flat);
      // Previews and the result are of the same picture: who has come closer stays there.
      if (!(flat_camera_ && flat_camera_->content() == content.flat->size))
        flat_camera_ = FlatCamera(content.flat->size, screen_->size());
    }
    solid_camera_.reset();
    solid_ = false;
    if (content.solid && (content.solid_first || !content.flat)) show_solid();
  }

  void show_solid() {
    solid_ = true;
    if (solid_camera_) return;
    const std::shared_ptr<const Scene> scene = content_.solid();
    const std::vector<PlacedMesh> placed = placed_meshes(*scene);
    solid_painter_.show(*scene, placed);
    const Size size = screen_->size();
    solid_camera_ = OrbitCamera(bounds_of(*scene, placed), size.width / size.height);
  }

  void switch_solid() {
    if (solid_ && content_.flat) {
      solid_ = false;
    } else if (!solid_ && content_.solid) {
      show_solid();
    }
  }

  bool is_blurred() const { return !solid_ && flat_painter_.is_blurred(); }

  // In the title and as a bar, whether that is to be drawn anew.
  bool tell(const News& news) {
    const bool works = news.state == News::State::kWorking;
    const std::string title = works ? fmt::format("{} - {} {:.0f} %", options_.title, news.stage, 100 * news.fraction)
                                    : options_.title + " - h: keys";
    if (title != title_) screen_->set_title(title_ = title);
    const double fraction = works ? news.fraction : 1;
    return std::exchange(fraction_, fraction) != fraction;
  }

  // ---- Drawing

  void draw(bool sharply) {
    const auto [width, height] = screen_->size();
    glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    clear(solid_ ? Rgb{196, 203, 210} : Rgb{48, 50, 54});
    if (solid_) {
      solid_painter_.draw(*solid_camera_);
    } else if (flat_camera_) {
      flat_painter_.draw(*flat_camera_, sharply);
    }
    if (fraction_ < 1) draw_bar(width);
  }

  void draw_bar(double width) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, static_cast<GLsizei>(width * fraction_), kBarHeight);
    clear({240, 150, 40});
    glDisable(GL_SCISSOR_TEST);
  }

  // Drawn again, since what has been presented cannot be read.
  Result<void> save() {
    draw(true);
    return options_.save(screen_->picture());
  }

  // ---- Events

  // Whether there were any.
  bool handle_events() {
    SDL_Event event;
    if (screen_->sdl.WaitEventTimeout(&event, kFrameMs) == 0) return false;
    do handle(event);
    while (screen_->sdl.PollEvent(&event) != 0);
    return true;
  }

  void handle(const SDL_Event& event) {
    switch (event.type) {
      case SDL_QUIT: quits_ = true; break;
      case SDL_WINDOWEVENT: on_window(event.window); break;
      case SDL_KEYDOWN: on_key(event.key.keysym.sym); break;
      case SDL_MOUSEWHEEL: on_wheel(event.wheel); break;
      case SDL_MOUSEMOTION: on_motion(event.motion); break;
      default: break;
    }
  }

  void on_window(const SDL_WindowEvent& event) {
    if (event.event != SDL_WINDOWEVENT_SIZE_CHANGED) return;
    const Size size = screen_->size();
    if (flat_camera_) flat_camera_->resize(size);
    if (solid_camera_) solid_camera_->resize(size.width / size.height);
  }

  void on_key(SDL_Keycode key) {
    switch (key) {
      case SDLK_ESCAPE:
      case SDLK_q: quits_ = true; break;
      case SDLK_PLUS:
      case SDLK_EQUALS:
      case SDLK_KP_PLUS: zoom(middle(), kZoomStep); break;
      case SDLK_MINUS:
      case SDLK_KP_MINUS: zoom(middle(), 1 / kZoomStep); break;
      case SDLK_0:
      case SDLK_KP_0: reset(); break;
      case SDLK_LEFT: step({1, 0}); break;
      case SDLK_RIGHT: step({-1, 0}); break;
      case SDLK_UP: step({0, 1}); break;
      case SDLK_DOWN: step({0, -1}); break;
      case SDLK_TAB: switch_solid(); break;
      case SDLK_s:
        if (const auto saved = save(); !saved) options_.say(saved.error().field + ": " + saved.error().message);
        break;
      case SDLK_h: options_.say(key_help()); break;
      default: break;
    }
  }

  void on_wheel(const SDL_MouseWheelEvent& wheel) {
    int x = 0, y = 0;
    screen_->sdl.GetMouseState(&x, &y);
    zoom(screen_->density() * Point{0.0 + x, 0.0 + y}, std::pow(kZoomStep, wheel.preciseY));
  }

  void on_motion(const SDL_MouseMotionEvent& motion) {
    if (motion.state == 0) return;
    const Point by = screen_->density() * Point{0.0 + motion.xrel, 0.0 + motion.yrel};
    const double height = screen_->size().height;
    const bool moves = (motion.state & SDL_BUTTON_LMASK) == 0 || (screen_->sdl.GetModState() & KMOD_SHIFT) != 0;
    if (solid_ && moves) {
      solid_camera_->pan({by.x / height, by.y / height});
    } else if (solid_) {
      solid_camera_->turn(-by.x / height * kTurnOfWindow, by.y / height * kTurnOfWindow);
    } else if (flat_camera_) {
      flat_camera_->pan(by);
    }
  }

  Point middle() const { return 0.5 * Point{screen_->size().width, screen_->size().height}; }

  void zoom(Point at, double factor) {
    if (solid_) {
      solid_camera_->zoom(factor);
    } else if (flat_camera_) {
      flat_camera_->zoom_at(at, factor);
    }
  }

  // The content comes from where the arrow points to.
  void step(Point way) {
    const auto [width, height] = screen_->size();
    if (solid_) {
      solid_camera_->turn(-kTurnStep * way.x, kTurnStep * way.y);
    } else if (flat_camera_) {
      flat_camera_->pan(kPanStep * Point{width * way.x, height * way.y});
    }
  }

  void reset() {
    if (solid_camera_) solid_camera_->reset();
    if (flat_camera_) flat_camera_->fit();
  }

  const WindowOptions options_;
  std::unique_ptr<Screen> screen_;
  FlatPainter flat_painter_;
  SolidPainter solid_painter_;
  Content content_;
  bool solid_ = false;  // what is seen
  std::optional<FlatCamera> flat_camera_;
  std::optional<OrbitCamera> solid_camera_;  // there is one where the solid has been made
  std::string title_;
  double fraction_ = 0;
  bool quits_ = false;
};

Window::Window(std::unique_ptr<Stage> stage) : stage_(std::move(stage)) {}
Window::Window(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::open(const WindowOptions& options) {
  auto screen = Screen::open(options);
  if (!screen) return tl::unexpected<Status>(std::move(screen.error()));
  auto flat = FlatPainter::create();
  if (!flat) return no_window(flat.error().message);
  auto solid = SolidPainter::create();
  if (!solid) return no_window(solid.error().message);
  return Window(std::make_unique<Stage>(options, *std::move(screen), *std::move(flat), *std::move(solid)));
}

Result<void> Window::run(Feed& feed) { return stage_->run(feed); }

}  // namespace tessera::view

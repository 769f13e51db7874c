// Where in a window a flat thing is seen, and how large.
#pragma once

#include "tessera/geometry/point.h"

namespace tessera::view {

struct Size {
  double width = 0, height = 0;  // both above 0
  friend bool operator==(Size a, Size b) { return a.width == b.width && a.height == b.height; }
};

// Content in units of its own (source pixels), the window in its pixels; both from the top left corner, y down.
class FlatCamera {
 public:
  FlatCamera() = default;
  FlatCamera(Size content, Size window) : content_(content), window_(window) { fit(); }

  // All of the content, as large as the window allows; it stays so when the window changes its size.
  void fit();
  // Enlarges by `factor` (> 0) what is under `at`, which stays where it is. From a quarter of what fits, or of a
  // pixel a unit where that is less, to 64 pixels a unit or 16 times what fits.
  void zoom_at(Point at, double factor);
  // Moves the content by so many window pixels, but never so far that none of it is in the window's middle.
  void pan(Point by);
  void resize(Size window);

  Size content() const { return content_; }
  Size window() const { return window_; }
  double scale() const { return scale_; }  // window pixels a unit
  // Where in the window the content's top left corner is: whole pixels, so that what is drawn at this scale is shown
  // pixel by pixel.
  Point corner() const;
  Point to_window(Point content) const { return corner() + scale_ * content; }
  Point to_content(Point window) const { return 1 / scale_ * (window - corner_); }

 private:
  double fitting_scale() const;
  void limit();

  Size content_{1, 1}, window_{1, 1};
  double scale_ = 1;
  Point corner_;
  bool fits_ = true;
};

}  // namespace tessera::view

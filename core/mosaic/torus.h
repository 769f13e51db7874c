// Seamless mosaics: the picture as a torus, whose right side meets its left one and whose bottom meets its top.
//
// Steps that know nothing of this work on the picture with a margin of its own repetitions around it. Sites are those
// of the window within the margin; around it lie ghosts, copies of them.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/point.h"
#include "tessera/tessellation/outlines.h"
#include "tessera/tessellation/tessellation.h"
#include "tessera/voronoi/rasterizer.h"

namespace tessera::mosaic {

struct Torus {
  cv::Size period;  // of the window
  int margin = 0;   // px around it; 0: the picture is no torus

  bool wraps() const { return margin > 0; }
  cv::Rect window() const { return {margin, margin, period.width, period.height}; }
  cv::Size canvas() const { return {period.width + 2 * margin, period.height + 2 * margin}; }

  // The multiple of the period that is to be taken from p to bring it into the window.
  Point home_shift(Point p) const;
  Point wrapped(Point p) const { return wraps() ? p - home_shift(p) : p; }
  // The shortest of the ways that differ from `way` by multiples of the period.
  Point shortest(Point way) const;
  // What the window shows, repeated over the canvas.
  template <class T>
  cv::Mat_<T> repeated(const cv::Mat_<T>& window) const {
    if (!wraps()) return window;
    cv::Mat_<T> all;
    cv::copyMakeBorder(window, all, margin, margin, margin, margin, cv::BORDER_WRAP);
    return all;
  }
};

inline void bring_home(Site& site, const Torus& torus) {
  const Point p = torus.wrapped({site.x, site.y});
  site.x = p.x;
  site.y = p.y;
}

// The sites of a window and their copies in the margin.
class Ghosts {
 public:
  // Appends the copies to `sites`.
  Ghosts(const Torus& torus, Sites& sites);

  int count() const { return static_cast<int>(copies_.size()); }
  // Each copy where its site is now.
  void follow(Sites& sites) const;
  // The margin's labels made those of the window, one period further.
  void wrap(LabelMap& labels) const;
  // The window alone, each ghost's pixels its site's.
  LabelMap window_of(const LabelMap& labels) const;

 private:
  struct Copy {
    int site, columns, rows;  // by how many periods it is shifted
  };

  Copy copy_of(int label) const { return label < own_ ? Copy{label, 0, 0} : copies_[label - own_]; }
  std::size_t place_of(const Copy& copy) const {
    const int place = (copy.rows + reach_y_) * (2 * reach_x_ + 1) + copy.columns + reach_x_;
    return static_cast<std::size_t>(place) * own_ + copy.site;
  }
  int find(const Copy& copy) const;  // -1: there is none

  Torus torus_;
  int own_, reach_x_, reach_y_;
  std::vector<Copy> copies_;
  std::vector<int> labels_;  // of each copy of each site, -1: it lies beyond the canvas
};

// Arcs that are one on the torus get the same bends: those of the one that has most. Returns that one for each arc.
std::vector<int> share_bends(const Torus& torus, const CellGraph& graph, Bends& bends);

// Leaves of the cells that were assembled from the graph those of the window: the first `own` and, from `sites` on,
// which are no site's, what lies within it. Vertices that are one on the torus become one.
void fold(const Torus& torus, const CellGraph& graph, const Bends& bends, const std::vector<int>& shared, int own,
          int sites, Tessellation& t);

}  // namespace tessera::mosaic

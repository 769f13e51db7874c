// The wood around pieces that no piece needs: seams may give it to them (3.4).
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/angle.h"
#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/patch.h"

namespace tessera::parquetry {

// Between two pieces of a panel each may have what is nearer to it.
class SpareWood {
 public:
  // `patches`: rectangles, with the placements of all of them; kept by reference, as are the panels. Pixels that are
  // taken are `apart` px or more from those of other pieces, and `inside` px from the middles of pixels that are no
  // wood.
  SpareWood(const std::vector<Panel>& panels, const std::vector<Patch>& patches,
            const std::vector<Placement>& placements, double apart, double inside);

  // Of the target's pixels in `box`, which holds that of the patch, those that it may have: 255. Those of its own box
  // always are; none else, where it has no wood.
  cv::Mat1b around(std::size_t patch, cv::Rect box) const;

 private:
  // A patch on its panel, and a way to ask how far places are from it.
  struct Cell {
    int panel = -1;
    Point middle;
    Angle angle;
    double width = 0, height = 0, reach = 0;

    Point on_panel(Point off) const;  // from the middle of the patch, on the target
    double distance(Point on_panel) const;
  };
  std::vector<const Cell*> near(const Cell& cell, double reach) const;

  const std::vector<Patch>& patches_;
  double apart_, inside_;
  std::vector<cv::Mat1f> depths_;  // of the panels
  std::vector<Cell> cells_;        // of the patches
};

}  // namespace tessera::parquetry

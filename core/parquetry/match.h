// Template matching (3.3, Eq. 4): the best place for a patch, exactly.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "tessera/parquetry/frames.h"
#include "tessera/parquetry/levels.h"
#include "tessera/parquetry/template.h"
#include "tessera/parquetry/wood.h"

namespace tessera::parquetry {

struct Match {
  std::int64_t cost = 0;  // Eq. 4: squared differences of 8-bit features, over the patch's mask and all features
  int view = 0;           // index in the views; in the order of panels and rotations
  cv::Point at;           // in its frame

  // Equal costs go to the earlier panel, rotation, row and column.
  friend bool operator<(const Match& a, const Match& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    if (a.view != b.view) return a.view < b.view;
    return a.at.y != b.at.y ? a.at.y < b.at.y : a.at.x < b.at.x;
  }
};

// Of what finds no wood: more than a whole picture of pieces.
inline std::int64_t cost_or_worst(const std::optional<Match>& match) {
  return match ? match->cost : std::int64_t{1} << 50;
}

inline constexpr std::int64_t kAnyCost = std::numeric_limits<std::int64_t>::max();

// Panels' features in all their views. Features are turned, not the pictures before: real wood does not lose detail
// by being turned, as interpolated pictures and then their gradients do, so that a panel's edges are as strong in all
// of its frames, and no direction is at an advantage. (The paper turns pictures, Eq. 3.)
//
// A view takes 3 bytes a pixel and feature or so: all of them are held, so that each patch can be looked for in what
// is left when its turn comes.
class Matcher {
 public:
  // `features` of the panels, in their order; `sides` of coarse blocks: all that templates will have. The views
  // outlive this.
  Matcher(const std::vector<cv::Mat>& features, const std::vector<cv::Mat1b>& masks, const std::vector<View>& views,
          const std::vector<int>& sides);

  const ByteCode& code() const { return code_; }
  const std::vector<View>& views() const { return views_; }

  // The best whole-pixel place of all views where the patch fits into the wood, of cost `limit` or less; none where
  // there is none. The same for any number of threads.
  //
  // Groups of positions first, by blocks of 16 px (smaller ones where the patch does not hold them), then single
  // positions by blocks of 4 px, then their pixels: each a bound from below, given up above the best cost so far.
  // Block by block and pixel by pixel, what has not been compared yet counts with the bound of the level before.
  std::optional<Match> best(const Template& patch, const Wood& wood, std::int64_t limit = kAnyCost);

  // A good place, soon: the best in the most promising group of each view's twelfth.
  std::optional<Match> glance(const Template& patch, const Wood& wood);

  // Eq. 4 at a position where the patch's box is inside the frame.
  std::int64_t cost(const Template& patch, int view, cv::Point at) const;

  // A view's features in a box; 0 outside its frame.
  cv::Mat features(int view, cv::Rect box) const;

  std::size_t bytes() const;

 private:
  struct Frame {
    Rows features, fine;
    std::vector<Rows> coarse;           // as in sides_
    std::vector<std::uint16_t> bounds;  // of groups, row by row, `stride` apart: what was found last
    int stride = 0;
  };
  class Search;
  std::optional<Match> search(const Template& patch, const Wood& wood, std::int64_t limit, bool closely);
  int level_of(int side) const;             // in sides_, where it must be
  Spot spot(int view, cv::Point at) const;  // the features there

  std::vector<int> sides_;
  ByteCode code_;
  const std::vector<View>& views_;
  std::vector<Frame> frames_;
};

}  // namespace tessera::parquetry

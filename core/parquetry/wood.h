// The wood that is left: what the masks allow, less what has been cut (3.3: a binary mask carried along, here as
// exact polygons).
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/geometry/polygon.h"
#include "tessera/parquetry/frames.h"
#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/shape.h"

namespace tessera::parquetry {

inline constexpr double kHalfDiagonal = 0.70710678118654757;  // of a pixel: no place is farther from its middle

// How far it is from a pixel's middle to that of the next that is no wood, px; beside the panel none are.
cv::Mat1f depth_of(const cv::Mat1b& mask);

// A panel in one of its rotations.
struct View {
  int panel = 0;
  int rotation = 0;
  Turn turn;
  std::vector<Span> groups;  // of the frame's squares of kGroup px, those that touch the panel
};
std::vector<View> views_of(const std::vector<Panel>& panels, const Params& params);

// All lengths in pixels of the panels. A cut is a ring on the panel, clockwise on the screen; it keeps `clearance`
// from other cuts, from the panel's sides and from all pixels that are no wood: from their middles half a pixel's
// diagonal more.
class Wood {
 public:
  // The views outlive this. `reach`: how far from a place anybody wants to know the room around it.
  Wood(const std::vector<Panel>& panels, const std::vector<View>& views, double clearance, double reach);

  double clearance() const { return clearance_; }
  bool fits(int panel, const Ring& cut) const;
  // Whether the shape may fit somewhere in a group of positions, by the room at its places: false where it cannot.
  bool has_room(int view, const Shape& shape, cv::Point group) const;
  // The cuts that are nearer than the clearance, in ascending order; the masks do not matter here.
  std::vector<int> in_the_way(int panel, const Ring& cut) const;
  bool on_wood(int panel, const Ring& cut) const;  // what has been cut does not matter here

  // Takes wood away under a number of the caller's, >= 0, that is not in use; puts it back.
  void take(int id, int panel, Ring cut);
  void put_back(int id);

  // For each group of a view's frame the distance from its middle, (1.5, 1.5) px from its corner, to the next cut or
  // what is no wood; rounded up, at most 255, and as far as `reach` decides anything.
  const Rows& room(int view) const { return room_[view]; }

 private:
  struct Cut {
    int panel;
    Ring ring;
  };
  struct Sheet {
    cv::Size size;
    cv::Mat1b mask;
    cv::Mat1f depth;
    cv::Mat1w missing;                         // of each row, how many pixels left of a column are no wood, mod 2^16
    int columns = 0, rows = 0;                 // of bins
    std::vector<std::vector<cv::Point>> rims;  // of each bin: pixels that are no wood beside some that are
    std::vector<std::vector<int>> cuts;        // of each bin: cuts whose bounds touch it, in ascending order
  };
  static constexpr int kBin = 64;  // px

  // Whether all sides are at least that far from the middles of pixels that are no wood, by depths of pixels alone.
  enum class Way { kFree, kBlocked, kUnsure };
  Way along(const Sheet& sheet, const Ring& cut, double apart) const;
  bool is_wood_inside(const Sheet& sheet, const Ring& cut) const;

  void measure_depth(const Panel& panel, Sheet& sheet) const;
  template <class Visit>
  void each_bin(const Sheet& sheet, const Ring& ring, double margin, const Visit& visit) const;
  std::uint8_t bare_room(const Sheet& sheet, const Turn& turn, int x, int y) const;
  template <class Visit>
  void each_group_near(int view, const Ring& cut, const Visit& visit);
  void narrow_room(int view, const Ring& cut);
  void widen_room(int view, const Ring& cut);

  const std::vector<View>& views_;
  double clearance_, reach_;
  std::vector<Sheet> sheets_;
  std::vector<Rows> room_;
  std::map<int, Cut> cuts_;
};

}  // namespace tessera::parquetry

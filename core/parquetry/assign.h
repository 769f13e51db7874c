// Patches get their wood, one after the other (3.3).
#pragma once

#include <optional>
#include <vector>

#include "tessera/parquetry/match.h"
#include "tessera/parquetry/panel.h"
#include "tessera/parquetry/params.h"
#include "tessera/parquetry/patch.h"
#include "tessera/parquetry/wood.h"

namespace tessera::parquetry {

// A patch and its place; Placement::patch means nothing here.
struct Laid {
  Patch patch;
  Placement placement;
};

// Panels and targets, ready to be matched.
class Workshop {
 public:
  // `targets`: RGB. `patches`: all that will be laid are among these or quarters of them. Only `panels` are kept, by
  // reference.
  Workshop(const std::vector<Panel>& panels, const std::vector<cv::Mat3b>& targets, const std::vector<Patch>& patches,
           const Params& params);
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  const Params& params() const { return params_; }
  double mm_per_px() const { return mm_per_px_; }
  Matcher& matcher() { return *matcher_; }
  Wood fresh_wood() const { return Wood(panels_, views_, params_.clearance_mm / mm_per_px_, reach_); }

  Template template_of(const Patch& patch) const;
  Ring cut_of(const Template& piece, const Match& match) const;
  Placement placement_of(const Template& piece, const std::optional<Match>& match) const;  // panel -1 for no match
  std::optional<Match> match_of(const Placement& placement) const;
  const cv::Mat& features_of_target(int target) const { return features_[target]; }
  const std::vector<Panel>& panels() const { return panels_; }
  // How far a piece's cut may be outside its outline, px: half the kerf, and what seams need.
  double beside() const { return beside_; }
  // Of the wood that is laid for a patch, and of that around it: for the pixels in `box` of the target. 0 beside the
  // panel; empty for no wood.
  cv::Mat features_of_wood(const Laid& laid, cv::Rect box) const;

 private:
  const std::vector<Panel>& panels_;
  Params params_;
  double mm_per_px_, beside_, reach_ = 0;
  std::vector<View> views_;
  std::vector<cv::Mat> features_;  // of the targets
  std::optional<Matcher> matcher_;
};

// Takes the best wood that is left for each patch that comes.
class Greedy {
 public:
  // The workshop outlives this.
  explicit Greedy(Workshop& workshop) : workshop_(workshop), wood_(workshop.fresh_wood()) {}

  // The patch; or with adaptive levels its quarters, where
  //   cost of the quarters, each laid into what those before it leave < adaptiveFactor * its own cost,
  // or where they find wood and it does not. For the quarters the same is asked again. What finds no wood gets the
  // panel -1 and no cost.
  std::vector<Laid> lay(const Patch& patch);

  // A piece that was laid before takes its wood away.
  void lay_again(const Laid& laid);

 private:
  void take(const Template& piece, const Match& match);
  bool is_better_in_quarters(const std::vector<Patch>& quarters, const std::optional<Match>& whole);

  Workshop& workshop_;
  Wood wood_;
  int taken_ = 0;  // cuts, which are numbered in their order
};

}  // namespace tessera::parquetry

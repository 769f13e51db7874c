#include "tessera/parquetry/assign.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "tessera/parquetry/features.h"
#include "tessera/parquetry/patches.h"

namespace tessera::parquetry {
namespace {

// Eq. 1 to 3: the panels' features, and the targets' with their tones moved towards those of all panels together.
std::vector<cv::Mat> features_of_panels(const std::vector<Panel>& panels, const Params& params) {
  std::vector<cv::Mat> features;
  for (const Panel& panel : panels) features.push_back(features_of(panel.scan, params));
  return features;
}

Histogram histogram_of_wood(const std::vector<Panel>& panels) {
  Histogram all{};
  for (const Panel& panel : panels) {
    const Histogram own = histogram_of(intensity_of(panel.scan), panel.mask);
    for (std::size_t level = 0; level < all.size(); ++level) all[level] += own[level];
  }
  return all;
}

std::vector<cv::Mat1b> masks_of(const std::vector<Panel>& panels) {
  std::vector<cv::Mat1b> masks;
  for (const Panel& panel : panels) masks.push_back(panel.mask);
  return masks;
}

// Of the patches, and as often as they may be quartered of their quarters.
std::vector<Patch> with_quarters(std::vector<Patch> patches, const Params& params, double mm_per_px) {
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches[i].level >= params.adaptive_levels) continue;
    const std::vector<Patch> parts = quarters(patches[i], params, mm_per_px);
    patches.insert(patches.end(), parts.begin(), parts.end());
  }
  return patches;
}

}  // namespace

Workshop::Workshop(const std::vector<Panel>& panels, const std::vector<cv::Mat3b>& targets,
                   const std::vector<Patch>& patches, const Params& params)
    : panels_(panels),
      params_(params),
      mm_per_px_(panels.front().mm_per_px),
      beside_(0.5 * params.kerf_mm / mm_per_px_ + seam_play(params, mm_per_px_)),
      views_(views_of(panels, params)) {
  const Histogram wood = histogram_of_wood(panels);
  for (const cv::Mat3b& target : targets) {
    const Tones tones = matched_tones(histogram_of(intensity_of(target), {}), wood, params.weight_histogram);
    features_.push_back(features_of(target, params, &tones));
  }
  std::set<int> sides;
  for (const Patch& patch : with_quarters(patches, params, mm_per_px_)) {
    for (const Block& block : coarse_blocks(patch.mask)) sides.insert(block.side);
    reach_ = std::max(reach_, 0.5 * std::min(patch.box.width, patch.box.height));
  }
  reach_ += params.clearance_mm / mm_per_px_ + 2 * beside_ + kGroup;
  matcher_.emplace(features_of_panels(panels, params), masks_of(panels), views_,
                   std::vector<int>(sides.begin(), sides.end()));
}

Template Workshop::template_of(const Patch& patch) const {
  return make_template(patch, features_[patch.target], matcher_->code(), beside_);
}

Ring Workshop::cut_of(const Template& piece, const Match& match) const {
  const View& view = views_[match.view];
  return cut_at(piece.shape, view.turn, view.rotation, match.at).outer;
}

Placement Workshop::placement_of(const Template& piece, const std::optional<Match>& match) const {
  Placement placement;
  placement.from = piece.shape.middle;
  if (!match) return placement;
  const View& view = views_[match->view];
  placement = place(view.turn, view.rotation, piece.shape.size, match->at, piece.shape.middle);
  placement.panel = view.panel;
  placement.cost = match->cost;
  return placement;
}

std::optional<Match> Workshop::match_of(const Placement& placement) const {
  for (int v = 0; v < static_cast<int>(views_.size()); ++v)
    if (views_[v].panel == placement.panel && views_[v].rotation == placement.rotation)
      return Match{placement.cost, v, placement.at};
  return {};
}

cv::Mat Workshop::features_of_wood(const Laid& laid, cv::Rect box) const {
  const auto match = match_of(laid.placement);
  return match ? matcher_->features(match->view, box + (match->at - laid.patch.box.tl())) : cv::Mat();
}

void Greedy::take(const Template& piece, const Match& match) {
  wood_.take(taken_++, workshop_.matcher().views()[match.view].panel, workshop_.cut_of(piece, match));
}

void Greedy::lay_again(const Laid& laid) {
  if (const auto match = workshop_.match_of(laid.placement)) take(workshop_.template_of(laid.patch), *match);
}

std::vector<Laid> Greedy::lay(const Patch& patch) {
  const Template piece = workshop_.template_of(patch);
  const std::optional<Match> match = workshop_.matcher().best(piece, wood_);
  if (patch.level < workshop_.params().adaptive_levels) {
    const std::vector<Patch> parts = quarters(patch, workshop_.params(), workshop_.mm_per_px());
    if (!parts.empty() && is_better_in_quarters(parts, match)) {
      std::vector<Laid> all;
      for (const Patch& part : parts)
        for (Laid& laid : lay(part)) all.push_back(std::move(laid));
      return all;
    }
  }
  if (match) take(piece, *match);
  return {{patch, workshop_.placement_of(piece, match)}};
}

bool Greedy::is_better_in_quarters(const std::vector<Patch>& quarters, const std::optional<Match>& whole) {
  constexpr double kMost = 4e18;  // fits into 64 bits
  const double budget =
      whole ? std::min(kMost, workshop_.params().adaptive_factor * static_cast<double>(whole->cost)) : kMost;
  const int before = taken_;
  std::int64_t sum = 0;
  bool better = true;
  for (const Patch& part : quarters) {
    const Template piece = workshop_.template_of(part);
    const auto match = workshop_.matcher().best(piece, wood_, static_cast<std::int64_t>(budget) - sum);
    if (match) {
      sum += match->cost;
      take(piece, *match);
    }
    better = match && static_cast<double>(sum) < budget;
    if (!better) break;
  }
  while (taken_ > before) wood_.put_back(--taken_);
  return better;
}

}  // namespace tessera::parquetry

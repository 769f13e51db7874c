#include "tessera/parquetry/match.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

namespace tessera::parquetry {
namespace {

constexpr int kUnit = 16 * 16;       // pixels: coarse bounds are in squared bytes of as many
constexpr double kSlack = 1 + 1e-9;  // more than doubles lose

// The greatest sum of squared bytes, over blocks of `pixels`, that a place of cost `limit` may have.
double bytes_within(std::int64_t limit, int pixels, double scale) {
  return limit == kAnyCost ? std::numeric_limits<double>::infinity()
                           : kSlack * scale * scale * static_cast<double>(limit) / pixels;
}

}  // namespace

// One patch in one view.
class Matcher::Search {
 public:
  Search(const Matcher& matcher, int view, Frame& frame, const Template& patch, const Wood& wood,
         std::atomic<std::int64_t>& limit)
      : matcher_(matcher),
        view_(matcher.views_[view]),
        frame_(frame),
        patch_(patch),
        wood_(wood),
        limit_(limit),
        index_(view) {
    const cv::Size size = view_.turn.size();
    last_ = {size.width - patch.shape.size.width, size.height - patch.shape.size.height};
  }

  // Bounds of all groups; then the places in the most promising group of each band of rows.
  void look_over() {
    if (last_.x < 0 || last_.y < 0) return;
    constexpr int kBands = 4;
    const int rows = last_.y / kGroup + 1;
    for (int band = 0; band < kBands; ++band) {
      std::uint16_t least = kNoRoom;
      int least_row = 0;
      for (int y = rows * band / kBands; y < rows * (band + 1) / kBands; ++y) {
        const std::uint16_t found = bound_row(y);
        if (found < least) {
          least = found;
          least_row = y;
        }
      }
      if (least == kNoRoom) continue;
      const std::uint16_t* row = bounds(least_row);
      visit(static_cast<int>(std::find(row, row + frame_.stride, least) - row), least_row);
    }
  }

  // All places that can be as good as what was found.
  void look_closely() {
    if (last_.x < 0 || last_.y < 0) return;
    const bool smaller = patch_.coarse.size() > 1 && matcher_.level_of(patch_.coarse[1].side) >= 0;
    for (int y = 0; y <= last_.y / kGroup; ++y) {
      found_.clear();
      find_at_most(bounds(y), last_.x / kGroup + 1, coarse_limit(), found_);
      if (found_.empty()) continue;
      if (smaller) bound_found(y);
      for (const int x : found_)
        if (bounds(y)[x] <= coarse_limit()) visit(x, y);
    }
  }

  const std::optional<Match>& best() const { return best_; }

 private:
  std::uint16_t* bounds(int y) { return frame_.bounds.data() + static_cast<std::ptrdiff_t>(y) * frame_.stride; }

  // The groups of a row that have room for the patch: by the room at its deepest place, which is in group x + deep.x.
  std::uint16_t bound_row(int y) {
    std::uint16_t* row = bounds(y);
    const Shape& shape = patch_.shape;
    const Span& span = view_.groups[std::min<std::size_t>(y + shape.deep.y, view_.groups.size() - 1)];
    const int begin = std::max(0, span.begin - shape.deep.x);
    const int end = std::min(last_.x / kGroup + 1, span.end - shape.deep.x);
    std::fill(row, row + frame_.stride, kNoRoom);
    if (begin >= end) return kNoRoom;
    const std::uint8_t* room = wood_.room(index_).at(y + shape.deep.y, begin + shape.deep.x);
    const std::uint16_t least = bound_groups(patch_.coarse[0], y, {begin, end}, room, needed_room());
    std::fill(row + end, row + frame_.stride, kNoRoom);
    return least;
  }

  // Of groups that were found, by smaller blocks.
  void bound_found(int y) {
    wanted_.assign(frame_.stride + kRowPadding, 0);
    for (const int x : found_) wanted_[x] = 1;
    const Span span{found_.front(), found_.back() + 1};
    bound_groups(patch_.coarse[1], y, span, wanted_.data() + span.begin, 1);
  }

  std::uint16_t bound_groups(const Template::Coarse& coarse, int y, Span span, const std::uint8_t* room,
                             std::uint8_t need) {
    const Rows& level = frame_.coarse[matcher_.level_of(coarse.side)];
    const std::uint8_t* from = level.at(y, span.begin);
    blocks_.clear();
    for (const cv::Point block : coarse.blocks) blocks_.push_back(level.at(y + block.y, span.begin + block.x) - from);
    const int shift = coarse.side == 16 ? 0 : coarse.side == 8 ? 2 : 4;  // to what blocks of kUnit pixels have
    return coarse_bounds({from, level.plane_size(), 2 * matcher_.code_.channels, &blocks_, coarse.moments.data(),
                          room, need, shift, span.end - span.begin},
                         bounds(y) + span.begin);
  }

  // The room a group needs: a place of the patch `depth` inside it is at most 1.5 px across and down from its middle.
  std::uint8_t needed_room() const {
    const double need = patch_.shape.depth + wood_.clearance() - 1.5 * std::sqrt(2.0) - 1e-6;
    return static_cast<std::uint8_t>(std::clamp(std::ceil(need), 0.0, 255.0));
  }

  std::uint16_t coarse_limit() {
    follow_limit();
    return coarse_limit_;
  }

  // What others have found counts here too.
  void follow_limit() {
    const std::int64_t limit = limit_.load(std::memory_order_relaxed);
    if (limit == followed_) return;
    followed_ = limit;
    // A bound of kNoRoom - 1 may stand for a greater one: that is below such a limit only where all bounds are.
    const double most_coarse = bytes_within(limit, kUnit, matcher_.code_.scale);
    coarse_limit_ = static_cast<std::uint16_t>(std::min<double>(most_coarse, kNoRoom - 1));
    for (int off = 0; off < kGroup; ++off) fine_limit_[off] = fine_limit(patch_.fine[off], limit);
  }

  void visit(int group_x, int group_y) {
    const int right = std::min(last_.x, group_x * kGroup + kGroup - 1);
    const int bottom = std::min(last_.y, group_y * kGroup + kGroup - 1);
    for (int y = group_y * kGroup; y <= bottom; ++y)
      for (int x = group_x * kGroup; x <= right; ++x)
        if (may_be_better({x, y})) consider({x, y});
  }

  // By a bound of the fine blocks, then with the rows that they leave out, which are compared pixel by pixel.
  bool may_be_better(cv::Point at) {
    follow_limit();
    const int off = at.y % kGroup;
    const Template::Fine& fine = patch_.fine[off];
    const std::ptrdiff_t channels = matcher_.code_.channels;
    const std::int64_t blocks =
        squared_differences(fine.blocks, frame_.fine.data() + at.x % kGroup * frame_.fine.plane_size(),
                            frame_.fine.starts() + at.y / kGroup, at.x / kGroup * 2 * channels, fine_limit_[off]);
    if (blocks > fine_limit_[off]) return false;
    const std::int64_t strips = squared_differences(fine.strips, frame_.features.data(),
                                                    frame_.features.starts() + at.y, at.x * channels, followed_);
    return strips <= followed_ && blocks <= fine_limit(fine, followed_ - strips);
  }

  // Of the squared bytes of fine blocks, where these may cost `limit`.
  std::int64_t fine_limit(const Template::Fine& fine, std::int64_t limit) const {
    const double apart = fine.lost + std::sqrt(bytes_within(limit, kGroup * kGroup, matcher_.code_.scale));
    return static_cast<std::int64_t>(std::min(9e18, kSlack * apart * apart));
  }

  void consider(cv::Point at) {
    Match match{0, index_, at};
    match.cost = matcher_.cost(patch_, index_, at, followed_);
    if (match.cost > followed_ || (best_ && !(match < *best_))) return;
    if (!wood_.fits(view_.panel, cut_at(patch_.shape, view_.turn, view_.rotation, at).outer)) return;
    best_ = match;
    std::int64_t known = limit_.load(std::memory_order_relaxed);
    while (match.cost < known && !limit_.compare_exchange_weak(known, match.cost)) {
    }
  }

  const Matcher& matcher_;
  const View& view_;
  Frame& frame_;
  const Template& patch_;
  const Wood& wood_;
  std::atomic<std::int64_t>& limit_;
  int index_;
  cv::Point last_;  // position
  std::int64_t followed_ = -1;
  std::uint16_t coarse_limit_ = 0;
  std::array<std::int64_t, kGroup> fine_limit_{};
  std::vector<std::ptrdiff_t> blocks_;
  std::vector<int> found_;
  std::vector<std::uint8_t> wanted_;
  std::optional<Match> best_;
};

Matcher::Matcher(const std::vector<cv::Mat>& features, const std::vector<cv::Mat1b>& masks,
                 const std::vector<View>& views, const std::vector<int>& sides)
    : sides_(sides), code_(byte_code(features, masks)), views_(views), frames_(views.size()) {
  cv::parallel_for_({0, static_cast<int>(views.size())}, [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      const View& view = views[v];
      const std::vector<Span> pixels = view.turn.spans();
      const cv::Size size = view.turn.size();
      Frame& frame = frames_[v];
      frame.features = view.turn.turned(features[view.panel], size.width);
      frame.fine = fine_level(frame.features, pixels, view.groups, size, code_);
      for (const int side : sides_)
        frame.coarse.push_back(coarse_level(frame.features, pixels, view.groups, size, side, code_));
      frame.stride = (size.width / kGroup + 1 + 2 * kRowPadding) / kRowPadding * kRowPadding;
      frame.bounds.resize(static_cast<std::size_t>(frame.stride) * (view.groups.size() + 1));
    }
  });
}

std::optional<Match> Matcher::best(const Template& patch, const Wood& wood, std::int64_t limit) {
  assert(level_of(patch.coarse[0].side) >= 0);
  std::atomic<std::int64_t> shared = limit;
  std::vector<Search> searches;
  searches.reserve(views_.size());
  const int views = static_cast<int>(views_.size());
  for (int v = 0; v < views; ++v) searches.emplace_back(*this, v, frames_[v], patch, wood, shared);
  const auto all = [&](const auto& step) {
    cv::parallel_for_({0, views}, [&](const cv::Range& range) {
      for (int v = range.start; v < range.end; ++v) step(searches[v]);
    });
  };
  all([](Search& search) { search.look_over(); });
  all([](Search& search) { search.look_closely(); });
  std::optional<Match> best;
  for (const Search& search : searches)
    if (search.best() && (!best || *search.best() < *best)) best = search.best();
  return best;
}

std::int64_t Matcher::cost(const Template& patch, int view, cv::Point at, std::int64_t limit) const {
  const Rows& features = frames_[view].features;
  return squared_differences(patch.pixels, features.data(), features.starts() + at.y,
                             std::ptrdiff_t{at.x} * code_.channels, limit);
}

cv::Mat Matcher::features(int view, cv::Rect box) const {
  cv::Mat features(box.size(), CV_8UC(code_.channels));
  for (int y = 0; y < box.height; ++y)
    std::memcpy(features.ptr(y), frames_[view].features.at(box.y + y, box.x),
                static_cast<std::size_t>(box.width) * code_.channels);
  return features;
}

int Matcher::level_of(int side) const {
  const auto found = std::find(sides_.begin(), sides_.end(), side);
  return found == sides_.end() ? -1 : static_cast<int>(found - sides_.begin());
}

std::size_t Matcher::bytes() const {
  std::size_t sum = 0;
  for (const Frame& frame : frames_) {
    sum += frame.features.size() + frame.fine.size() + frame.bounds.size() * sizeof(std::uint16_t);
    for (const Rows& level : frame.coarse) sum += level.size();
  }
  return sum;
}

}  // namespace tessera::parquetry

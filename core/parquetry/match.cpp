#include "tessera/parquetry/match.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

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
    const std::size_t all = looks(patch.pixels.rows());
    limits_.resize(all);
    for (auto* each : {&fine_sums_, &sums_}) each->resize(kGroup * all);
    pixel_unit_ = kGroup * kGroup / (kSlack * matcher.code_.scale * matcher.code_.scale);
    left_.resize(all + 1);
  }

  // Where nothing is known yet: a place with room, so that bounds can be counted in units of a fitting size.
  void begin() {
    if (last_.x < 0 || last_.y < 0) return;
    const int rows = last_.y / kGroup + 1;
    for (int k = 0; k < rows && limit_.load(std::memory_order_relaxed) == kAnyCost; ++k) {
      const int y = (rows / 2 + k) % rows;
      const Span span = groups_of(y);
      if (span.begin >= span.end) continue;
      const std::uint8_t* room = room_of(y, span);
      const std::ptrdiff_t most = std::max_element(room, room + (span.end - span.begin)) - room;
      if (room[most] >= needed_room()) visit(span.begin + static_cast<int>(most), y, false);
    }
  }

  // Bounds of all groups; then the places in the most promising group of each band of rows.
  void look_over() {
    if (last_.x < 0 || last_.y < 0) return;
    constexpr int kBands = 12;
    const int rows = last_.y / kGroup + 1;
    choose_unit();
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
      least_ = std::min(least_, std::ldexp(least, coarser_));
      if (least > coarse_limit()) continue;
      const std::uint16_t* row = bounds(least_row);
      visit(static_cast<int>(std::find(row, row + frame_.stride, least) - row), least_row, false);
    }
  }

  // The least of the bounds of all groups, of blocks of kUnit pixels.
  double least() const { return least_; }

  // Bounds in other units, if what is known by now asks for them.
  void look_over_again() {
    if (last_.x < 0 || last_.y < 0 || !choose_unit()) return;
    for (int y = 0; y <= last_.y / kGroup; ++y) bound_row(y);
  }

  // All places that can be as good as what was found, in groups whose bounds are within that `share` of the way from
  // `least` to it; and which have not been looked at.
  void look_closely(double share, double least) {
    if (last_.x < 0 || last_.y < 0) return;
    const double low = std::ldexp(least, -coarser_);
    for (int y = 0; y <= last_.y / kGroup; ++y) {
      const double within = share * std::max(0.0, coarse_limit() - low);
      found_.clear();
      find_at_most(bounds(y), last_.x / kGroup + 1,
                   static_cast<std::uint16_t>(std::min<double>(low + within, coarse_limit())), found_);
      if (found_.empty()) continue;
      bound_upper(y);
      for (const int x : found_)
        if (bounds(y)[x] <= coarse_limit()) {
          if (wood_.has_room(index_, patch_.shape, {x, y})) visit(x, y, true);
          bounds(y)[x] = kNoRoom;
        }
    }
  }

  const std::optional<Match>& best() const { return best_; }

 private:
  std::uint16_t* bounds(int y) { return frame_.bounds.data() + static_cast<std::ptrdiff_t>(y) * frame_.stride; }

  // Of a row, between which there may be room for the patch: by that at its deepest place, in group x + deep.x.
  Span groups_of(int y) const {
    const Shape& shape = patch_.shape;
    const Span& span = view_.groups[std::min<std::size_t>(y + shape.deep.y, view_.groups.size() - 1)];
    return {std::max(0, span.begin - shape.deep.x), std::min(last_.x / kGroup + 1, span.end - shape.deep.x)};
  }
  const std::uint8_t* room_of(int y, Span groups) const {
    return wood_.room(index_).at(y + patch_.shape.deep.y, groups.begin + patch_.shape.deep.x);
  }

  // The least bound of the groups that have room.
  std::uint16_t bound_row(int y) {
    std::uint16_t* row = bounds(y);
    const Span span = groups_of(y);
    std::fill(row, row + frame_.stride, kNoRoom);
    if (span.begin >= span.end) return kNoRoom;
    const std::uint16_t least = bound_groups(y, span, room_of(y, span), needed_room(), row, nullptr);
    std::fill(row + span.end, row + frame_.stride, kNoRoom);
    return least;
  }

  // The bounds of the upper bands of blocks alone, of groups that were found.
  void bound_upper(int y) {
    wanted_.assign(frame_.stride + kRowPadding, 0);
    for (const int x : found_) wanted_[x] = 1;
    const Span span{found_.front(), found_.back() + 1};
    whole_.resize(upper_stride());
    upper_.resize(patch_.coarse.bands.size() * upper_stride());
    bound_groups(y, span, wanted_.data() + span.begin, 1, whole_.data(), upper_.data());
  }
  std::ptrdiff_t upper_stride() const { return frame_.stride + kRowPadding; }

  // `bounds`, and if given `upper`: of the row.
  std::uint16_t bound_groups(int y, Span span, const std::uint8_t* room, std::uint8_t need, std::uint16_t* bounds,
                             std::uint16_t* upper) {
    const Template::Coarse& coarse = patch_.coarse;
    blocks_.clear();
    for (const Block& block : coarse.blocks) {
      const Rows& level = frame_.coarse[matcher_.level_of(block.side)];
      blocks_.push_back({level.at(y + block.at.y, span.begin + block.at.x), level.plane_size(), shift(block.side)});
    }
    CoarseRow row{&blocks_, 2 * matcher_.code_.channels, coarse.moments.data(), room,
                  need,     span.end - span.begin,       coarse_limit()};
    row.bands = &coarse.bands;
    row.sums = upper ? upper + span.begin : nullptr;
    row.stride = upper_stride();
    return coarse_bounds(row, bounds + span.begin);
  }

  // To squared bytes of blocks of kUnit pixels, or larger units.
  int shift(int side) const { return coarser_ + (side == 16 ? 0 : side == 8 ? 2 : 4); }

  // Bounds count in larger units where the limit would not fit into 16 bits, or only just above what rounding takes
  // from them. Whether they have to be counted anew.
  bool choose_unit() {
    const std::int64_t limit = limit_.load(std::memory_order_relaxed);
    if (limit == kAnyCost) return false;
    constexpr int kMostBits = 8;
    constexpr double kTooLittle = 1 << 11;
    const double most = bytes_within(limit, kUnit, matcher_.code_.scale), now = std::ldexp(most, -coarser_);
    if (now < kNoRoom - 1 && (coarser_ == 0 || now > kTooLittle)) return false;
    const int before = std::exchange(coarser_, 0);
    while (coarser_ < kMostBits && std::ldexp(most, -coarser_) > kNoRoom - 2) ++coarser_;
    followed_ = -1;
    return coarser_ != before;
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
    const double most_coarse = std::ldexp(bytes_within(limit, kUnit, matcher_.code_.scale), -coarser_);
    coarse_limit_ = static_cast<std::uint16_t>(std::min<double>(most_coarse, kNoRoom - 1));
  }

  // `bounded`: bound_upper() of its row was called.
  void visit(int group_x, int group_y, bool bounded) {
    follow_limit();
    limit_fine(group_x, bounded);
    const int bottom = std::min(last_.y, group_y * kGroup + kGroup - 1);
    for (int y = group_y * kGroup; y <= bottom; ++y) visit_row(group_x, y);
  }

  void visit_row(int group_x, int y) {
    const Template::Fine& fine = patch_.fine[y % kGroup];
    const Rows& level = frame_.fine;
    const Spot spot{level.data(), level.starts() + y / kGroup, std::ptrdiff_t{group_x} * 2 * matcher_.code_.channels};
    const unsigned within =
        compare_four(fine.blocks, spot, level.plane_size(), fine_limits_[y % kGroup].data(), fine_sums_.data());
    const int x = group_x * kGroup, count = std::min(kGroup, last_.x + 1 - x);
    if ((within & ((1u << count) - 1)) == 0) return;
    follow_limit();
    // With the pixels of the strips.
    std::array<std::int64_t, kGroup> blocks{};
    for (int i = 0; i < count; ++i) blocks[i] = cost_of_blocks(fine, i, 0);
    std::int64_t least = kAnyCost;
    for (int i = 0; i < count; ++i)
      if ((within >> i & 1) != 0) least = std::min(least, blocks[i]);
    std::fill_n(limits_.begin(), looks(fine.strips.rows()), followed_ - least);
    const Spot pixels = matcher_.spot(index_, {x, y});
    const unsigned both =
        within & compare_four(fine.strips, pixels, matcher_.code_.channels, limits_.data(), sums_.data());
    const int last_look = looks(fine.strips.rows()) - 1;
    unsigned left = 0;
    for (int i = 0; i < count; ++i)
      if ((both >> i & 1) != 0 && (last_look < 0 || sums_[kGroup * last_look + i] + blocks[i] <= followed_))
        left |= 1U << i;
    if (left != 0) compare_pixels({x, y}, left, fine);
  }

  // The places `left` of four from `at` on, as bits: by the pixels, with the fine blocks of what has not been
  // compared.
  void compare_pixels(cv::Point at, unsigned left, const Template::Fine& fine) {
    for (std::size_t look = 0; look < fine.lost_rest.size(); ++look) {
      std::int64_t least = kAnyCost;
      for (int i = 0; i < kGroup; ++i)
        if ((left >> i & 1) != 0) least = std::min(least, cost_of_blocks(fine, i, look));
      left_[look] = followed_ - least;
    }
    for (std::size_t i = 0; i < limits_.size(); ++i) limits_[i] = left_[fine.looks[i]];
    left &=
        compare_four(patch_.pixels, matcher_.spot(index_, at), matcher_.code_.channels, limits_.data(), sums_.data());
    for (int i = 0; i < kGroup; ++i)
      if ((left >> i & 1) != 0) consider({at.x + i, at.y}, sums_[sums_.size() - kGroup + i]);
  }

  // What fine blocks may sum up to at each look, if the coarse ones above them cost no more than their bounds.
  void limit_fine(int group_x, bool bounded) {
    const double all = bytes_within(followed_, kGroup * kGroup, matcher_.code_.scale);
    const double unit = std::ldexp(1.0 * kUnit / (kGroup * kGroup), coarser_);
    left_below_.assign(1, std::sqrt(all));
    for (std::size_t band = 0; bounded && band < patch_.coarse.bands.size(); ++band) {
      const double left = all - unit * upper_[band * upper_stride() + group_x];
      left_below_.push_back(left < 0 ? -1 : std::sqrt(left));
    }
    for (int off = 0; off < kGroup; ++off) {
      const Template::Fine& fine = patch_.fine[off];
      fine_limits_[off].resize(fine.lost.size());
      for (std::size_t look = 0; look < fine.lost.size(); ++look) {
        const double left = left_below_[bounded ? fine.bands_above[look] : 0];
        const double apart = fine.lost[look] + left;
        fine_limits_[off][look] = left < 0 ? -1 : static_cast<std::int64_t>(std::min(9e18, kSlack * apart * apart));
      }
    }
  }

  // The bound of the fine blocks that have not been compared after some looks.
  std::int64_t cost_of_blocks(const Template::Fine& fine, int column, std::size_t look) const {
    const auto sum = [&](std::size_t looks) { return looks == 0 ? 0 : fine_sums_[kGroup * (looks - 1) + column]; };
    const double rest = std::sqrt(static_cast<double>(sum(fine.lost.size()) - sum(look)));
    const double apart = std::max(0.0, rest - fine.lost_rest[look]);
    return static_cast<std::int64_t>(pixel_unit_ * apart * apart);
  }

  void consider(cv::Point at, std::int64_t cost) {
    const Match match{cost, index_, at};
    if (best_ && !(match < *best_)) return;
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
  int coarser_ = 0;  // bits that bounds have lost
  double least_ = std::numeric_limits<double>::infinity();
  std::vector<CoarseBlock> blocks_;
  std::vector<int> found_;
  std::vector<std::uint8_t> wanted_;
  std::vector<std::uint16_t> whole_, upper_;  // of a row of groups; for each band
  std::vector<double> left_below_;            // a band and those above it, at most: a distance; -1: nothing
  std::array<std::vector<std::int64_t>, kGroup> fine_limits_;
  std::vector<std::int64_t> limits_, left_, sums_, fine_sums_;
  double pixel_unit_ = 0;
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
  return search(patch, wood, limit, true);
}

std::optional<Match> Matcher::glance(const Template& patch, const Wood& wood) {
  return search(patch, wood, kAnyCost, false);
}

std::optional<Match> Matcher::search(const Template& patch, const Wood& wood, std::int64_t limit, bool closely) {
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
  all([](Search& search) { search.begin(); });
  all([](Search& search) { search.look_over(); });
  if (closely) {
    all([](Search& search) { search.look_over_again(); });
    double least = std::numeric_limits<double>::infinity();
    for (const Search& search : searches) least = std::min(least, search.least());
    // The most promising ones lower the limit for the others.
    for (const double share : {0.3, 0.7, 1.0}) all([&](Search& search) { search.look_closely(share, least); });
  }
  std::optional<Match> best;
  for (const Search& search : searches)
    if (search.best() && (!best || *search.best() < *best)) best = search.best();
  return best;
}

Spot Matcher::spot(int view, cv::Point at) const {
  const Rows& features = frames_[view].features;
  return {features.data(), features.starts() + at.y, std::ptrdiff_t{at.x} * code_.channels};
}

std::int64_t Matcher::cost(const Template& patch, int view, cv::Point at) const {
  const int all = looks(patch.pixels.rows());
  const std::vector<std::int64_t> limits(all, kAnyCost);
  std::vector<std::int64_t> sums(all);
  compare(patch.pixels, spot(view, at), limits.data(), sums.data());
  return sums.back();
}

cv::Mat Matcher::features(int view, cv::Rect box) const {
  const int channels = code_.channels;
  cv::Mat features(box.size(), CV_8UC(channels), cv::Scalar::all(0));
  const cv::Rect inside = box & cv::Rect({0, 0}, views_[view].turn.size());
  for (int y = inside.y; y < inside.br().y; ++y)
    std::memcpy(features.ptr(y - box.y) + static_cast<std::ptrdiff_t>(inside.x - box.x) * channels,
                frames_[view].features.at(y, inside.x), static_cast<std::size_t>(inside.width) * channels);
  return features;
}

int Matcher::level_of(int side) const {
  const auto found = std::find(sides_.begin(), sides_.end(), side);
  assert(found != sides_.end());
  return static_cast<int>(found - sides_.begin());
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

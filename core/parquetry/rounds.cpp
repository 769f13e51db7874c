#include "tessera/parquetry/rounds.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace tessera::parquetry {
namespace {

constexpr int kPatience = 2;  // rounds without gain

using Matches = std::vector<std::optional<Match>>;

class Rounds {
 public:
  Rounds(Workshop& workshop, const std::vector<Laid>& pieces) : workshop_(workshop), losses_(pieces.size(), 0) {
    const Wood fresh = workshop.fresh_wood();
    for (const Laid& laid : pieces) {
      pieces_.push_back(workshop.template_of(laid.patch));
      best_.push_back(workshop.match_of(laid.placement));
      firsts_.push_back(cost_or_worst(workshop.matcher().glance(pieces_.back(), fresh)));
    }
    count_losses(best_);
  }

  // None where time ran out.
  std::optional<Matches> lay(const std::function<bool()>& go_on) {
    std::vector<int> order(pieces_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return losses_[a] > losses_[b]; });
    Wood wood = workshop_.fresh_wood();
    Matches matches(pieces_.size());
    for (const int piece : order) {
      if (!go_on()) return {};
      const auto& match = matches[piece] = workshop_.matcher().best(pieces_[piece], wood);
      if (match)
        wood.take(piece, workshop_.matcher().views()[match->view].panel, workshop_.cut_of(pieces_[piece], *match));
    }
    count_losses(matches);
    return matches;
  }

  // Whether it is better than the best so far, and then the best.
  bool keep(Matches matches) {
    if (cost_of(matches) >= cost_of(best_)) return false;
    best_ = std::move(matches);
    return true;
  }

  Placement placement(int piece) const { return workshop_.placement_of(pieces_[piece], best_[piece]); }

 private:
  // Older losses count less.
  void count_losses(const Matches& matches) {
    for (std::size_t i = 0; i < matches.size(); ++i)
      losses_[i] += std::max<std::int64_t>(0, cost_or_worst(matches[i]) - firsts_[i]) - 3 * (losses_[i] / 10);
  }
  // Pieces without wood, and the others' cost.
  static std::pair<int, std::int64_t> cost_of(const Matches& matches) {
    std::pair<int, std::int64_t> sum;
    for (const auto& match : matches) {
      if (match)
        sum.second += match->cost;
      else
        ++sum.first;
    }
    return sum;
  }

  Workshop& workshop_;
  std::vector<Template> pieces_;
  std::vector<std::int64_t> firsts_, losses_;
  Matches best_;
};

}  // namespace

int lay_in_rounds(Workshop& workshop, std::vector<Laid>& pieces, const std::function<bool()>& go_on) {
  if (!go_on()) return 0;
  Rounds rounds(workshop, pieces);
  int laid = 0;
  for (int patience = kPatience; patience > 0;) {
    auto matches = rounds.lay(go_on);
    if (!matches) break;
    ++laid;
    patience = rounds.keep(*std::move(matches)) ? kPatience : patience - 1;
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].placement = rounds.placement(static_cast<int>(i));
  return laid;
}

}  // namespace tessera::parquetry

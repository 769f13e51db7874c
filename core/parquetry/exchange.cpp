#include "tessera/parquetry/exchange.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tessera::parquetry {
namespace {

constexpr int kMostTries = 8;  // places of a piece that are looked at, those that cost it least
constexpr int kMostMoved = 4;  // pieces that may be in the way

class Exchange {
 public:
  Exchange(Workshop& workshop, const std::vector<Laid>& pieces)
      : workshop_(workshop), whole_(workshop.fresh_wood()), wood_(workshop.fresh_wood()) {
    for (const Laid& laid : pieces) {
      pieces_.push_back(workshop.template_of(laid.patch));
      matches_.push_back(workshop.match_of(laid.placement));
      if (matches_.back()) take(static_cast<int>(pieces_.size()) - 1);
    }
    choices_.resize(pieces_.size());
  }

  int size() const { return static_cast<int>(pieces_.size()); }
  const std::optional<Match>& match(int piece) const { return matches_[piece]; }
  Placement placement(int piece) const { return workshop_.placement_of(pieces_[piece], matches_[piece]); }

  // What the piece would gain at the best place of all, were there no others.
  std::int64_t wish(int piece) {
    const auto first = choice(piece, 0);
    return first ? cost(piece) - first->cost : 0;
  }

  // Tries the places where the piece would cost less, `tries` of them, the best first.
  bool move(int piece, int tries, const std::function<bool()>& go_on) {
    for (int i = 0; i < tries && go_on(); ++i) {
      const auto place = choice(piece, i);
      if (!place) break;
      if (move_to(piece, *place)) return true;
    }
    return false;
  }

 private:
  // Places on wood without cuts, the i-th best one away from those before, if it costs less than the piece does now.
  std::optional<Match> choice(int piece, int i) {
    Choices& known = choices_[piece];
    const std::int64_t limit = cost(piece) - 1;
    if (i < static_cast<int>(known.best.size())) {
      if (known.best[i].cost > limit) return {};
      return known.best[i];
    }
    if (limit <= known.none_within) return {};
    int taken = 0;
    for (const Match& match : known.best)
      whole_.take(taken++, panel_of(match), workshop_.cut_of(pieces_[piece], match));
    const auto next = best(piece, whole_, limit);
    while (taken > 0) whole_.put_back(--taken);
    if (next) {
      known.best.push_back(*next);
    } else {
      known.none_within = limit;
    }
    return next;
  }

  std::int64_t cost(int piece) const { return cost_or_worst(matches_[piece]); }
  int panel_of(const Match& match) const { return workshop_.matcher().views()[match.view].panel; }
  std::optional<Match> best(int piece, const Wood& wood, std::int64_t limit) {
    return limit < 0 ? std::nullopt : workshop_.matcher().best(pieces_[piece], wood, limit);
  }
  void take(int piece) {
    wood_.take(piece, panel_of(*matches_[piece]), workshop_.cut_of(pieces_[piece], *matches_[piece]));
  }
  void set(int piece, const std::optional<Match>& match) {
    if (matches_[piece]) wood_.put_back(piece);
    matches_[piece] = match;
    if (match) take(piece);
  }

  bool move_to(int piece, const Match& place) {
    std::vector<int> others = wood_.in_the_way(panel_of(place), workshop_.cut_of(pieces_[piece], place));
    std::erase(others, piece);
    if (static_cast<int>(others.size()) > kMostMoved) return false;
    std::vector<std::pair<int, std::optional<Match>>> before{{piece, matches_[piece]}};
    std::int64_t gain = cost(piece) - place.cost;
    for (const int other : others) {
      before.emplace_back(other, matches_[other]);
      gain += cost(other);
      set(other, {});
    }
    set(piece, place);
    // Those that were better off choose first.
    std::stable_sort(before.begin() + 1, before.end(),
                     [](const auto& a, const auto& b) { return a.second->cost < b.second->cost; });
    for (std::size_t i = 1; i < before.size(); ++i) {
      const auto other = best(before[i].first, wood_, gain - 1);
      if (!other) {
        undo(before);
        return false;
      }
      gain -= other->cost;
      set(before[i].first, other);
    }
    return true;
  }

  void undo(const std::vector<std::pair<int, std::optional<Match>>>& before) {
    for (const auto& [piece, match] : before) set(piece, {});
    for (const auto& [piece, match] : before) set(piece, match);
  }

  struct Choices {
    std::vector<Match> best;
    std::int64_t none_within = -1;  // beyond those, nothing costs as little
  };

  Workshop& workshop_;
  Wood whole_, wood_;  // without cuts; with all pieces' cuts
  std::vector<Template> pieces_;
  std::vector<std::optional<Match>> matches_;
  std::vector<Choices> choices_;
};

}  // namespace

int exchange_places(Workshop& workshop, std::vector<Laid>& pieces, const std::function<bool()>& go_on) {
  Exchange exchange(workshop, pieces);
  int moves = 0;
  std::vector<int> order(pieces.size());
  std::iota(order.begin(), order.end(), 0);
  // Those first that may gain most; more places of a piece where that is at its end.
  for (int tries = 1; tries <= kMostTries && go_on();) {
    std::vector<std::int64_t> wishes(pieces.size(), 0);
    for (const int piece : order)
      if (go_on()) wishes[piece] = exchange.wish(piece);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return wishes[a] > wishes[b]; });
    int gained = 0;
    for (const int piece : order)
      if (go_on() && exchange.move(piece, tries, go_on)) ++gained;
    moves += gained;
    if (gained == 0) tries *= 2;
  }
  for (int i = 0; i < exchange.size(); ++i) pieces[i].placement = exchange.placement(i);
  return moves;
}

}  // namespace tessera::parquetry

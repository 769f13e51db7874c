#include "tessera/parquetry/improve.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tessera::parquetry {
namespace {

constexpr int kTries = 6;      // places of a piece that are looked at, those that cost it least
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
  }

  int size() const { return static_cast<int>(pieces_.size()); }
  const std::optional<Match>& match(int piece) const { return matches_[piece]; }
  Placement placement(int piece) const { return workshop_.placement_of(pieces_[piece], matches_[piece]); }

  // Tries places that cost the piece less than its own, the best first, each away from those before.
  bool move(int piece, const std::function<bool()>& go_on) {
    bool moved = false;
    int tried = 0;
    for (; tried < kTries && go_on(); ++tried) {
      const auto better = best(piece, whole_, cost(piece) - 1);
      if (!better) break;
      if (move_to(piece, *better)) {
        moved = true;
        break;
      }
      whole_.take(tried, panel_of(*better), workshop_.cut_of(pieces_[piece], *better));
    }
    while (tried > 0) whole_.put_back(--tried);
    return moved;
  }

 private:
  std::int64_t cost(int piece) const {
    constexpr std::int64_t kNone = std::int64_t{1} << 50;  // more than a whole picture of pieces
    return matches_[piece] ? matches_[piece]->cost : kNone;
  }
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

  Workshop& workshop_;
  Wood whole_, wood_;  // without cuts; with all pieces' cuts
  std::vector<Template> pieces_;
  std::vector<std::optional<Match>> matches_;
};

}  // namespace

int improve(Workshop& workshop, std::vector<Laid>& pieces, const std::function<bool()>& go_on) {
  Exchange exchange(workshop, pieces);
  int moves = 0;
  std::vector<int> order(pieces.size());
  std::iota(order.begin(), order.end(), 0);
  // The last to choose have lost most.
  std::reverse(order.begin(), order.end());
  for (bool gained = true; gained && go_on();) {
    gained = false;
    for (const int piece : order) {
      if (!go_on()) break;
      if (!exchange.move(piece, go_on)) continue;
      gained = true;
      ++moves;
    }
  }
  for (int i = 0; i < exchange.size(); ++i) pieces[i].placement = exchange.placement(i);
  return moves;
}

}  // namespace tessera::parquetry

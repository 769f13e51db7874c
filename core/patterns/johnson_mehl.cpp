#include "tessera/patterns/johnson_mehl.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "tessera/base/distributions.h"
#include "tessera/base/portable_math.h"
#include "tessera/points/point_grid.h"

namespace tessera::patterns {
namespace {

// A place is still free once circles have grown by g with the chance exp(-pi rate g^3 / 3); here exp(-35).
double last_growth(double rate) { return std::cbrt(105 / (kPi * rate)); }

// A length of the order of a cell's.
double cell_size(double rate) { return 1 / std::cbrt(rate); }

// 1 / radius, by direction about a nucleus, of the border with another: a cos + b sin + c. Two borders cross where
// their difference is 0, at most twice; the cell ends at the highest of all.
struct Border {
  double a = 0, b = 0, c = 0;

  double at(double angle) const {
    const SinCos turn = sin_cos(angle);
    return a * turn.cos + b * turn.sin + c;
  }
  double highest() const { return std::sqrt(a * a + b * b) + c; }
};

Border border_between(const Nucleus& own, const Nucleus& other) {
  const Point way = other.place - own.place;
  const double later = other.head_start - own.head_start;
  const double scale = 2 / (dot(way, way) - later * later);
  return {scale * way.x, scale * way.y, -scale * later};
}

// Directions where two borders meet; false where they do not.
bool crossings(const Border& f, const Border& g, double& one, double& two) {
  const double a = g.a - f.a, b = g.b - f.b, c = g.c - f.c, most = a * a + b * b;
  if (!(c * c < most)) return false;
  const double middle = atan2_portable(b, a), half = atan2_portable(std::sqrt(most - c * c), -c);
  one = middle - half;
  two = middle + half;
  return true;
}

constexpr int kFree = -1;  // no nucleus: the bound of growth

// The cell of one nucleus: its border by direction, as arcs that belong to one other nucleus each.
class Envelope {
 public:
  struct Arc {
    double begin;  // direction, radians; it ends where the next begins
    int other;
    Border border;
  };

  explicit Envelope(double bound) : arcs_{{0, kFree, {0, 0, 1 / bound}}}, reach_(bound) {}

  const std::vector<Arc>& arcs() const { return arcs_; }
  double reach() const { return reach_; }  // the farthest that the cell gets
  double end_of(std::size_t k) const { return k + 1 < arcs_.size() ? arcs_[k + 1].begin : arcs_[0].begin + 2 * kPi; }

  void add(int other, const Border& border) {
    if (border.highest() * reach_ <= 1) return;
    next_.clear();
    for (std::size_t k = 0; k < arcs_.size(); ++k) add_to(k, other, border);
    join();
    std::swap(arcs_, next_);
    measure();
  }

 private:
  // Cuts arc k where the new border crosses it, and gives each part to the higher one.
  void add_to(std::size_t k, int other, const Border& border) {
    const Arc& arc = arcs_[k];
    const double end = end_of(k);
    double cuts[3] = {arc.begin, end, end};
    int count = 1;
    if (double one = 0, two = 0; crossings(arc.border, border, one, two))
      for (double cut : {one, two}) {
        cut -= std::floor((cut - arc.begin) / (2 * kPi)) * 2 * kPi;  // the first one after the arc's begin
        if (cut > arc.begin && cut < end) cuts[count++] = cut;
      }
    if (cuts[1] > cuts[2]) std::swap(cuts[1], cuts[2]);
    for (int i = 0; i < count; ++i) {
      const double middle = (cuts[i] + (i + 1 < count ? cuts[i + 1] : end)) / 2;
      const bool is_new = border.at(middle) > arc.border.at(middle);
      next_.push_back(is_new ? Arc{cuts[i], other, border} : Arc{cuts[i], arc.other, arc.border});
    }
  }

  // Neighbouring arcs of one nucleus are one.
  void join() {
    const auto same = [](const Arc& a, const Arc& b) { return a.other == b.other; };
    next_.erase(std::unique(next_.begin(), next_.end(), same), next_.end());
    if (next_.size() > 1 && same(next_.front(), next_.back())) {
      // The last arc runs on into the first.
      next_.front().begin = next_.back().begin - 2 * kPi;
      next_.pop_back();
    }
  }

  void measure() {
    double least = 1e300;
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      const Arc& arc = arcs_[k];
      const double begin = arc.begin, end = end_of(k);
      least = std::min({least, arc.border.at(begin), arc.border.at(end)});
      double low = atan2_portable(arc.border.b, arc.border.a) + kPi;  // where the border is farthest away
      low -= std::floor((low - begin) / (2 * kPi)) * 2 * kPi;
      if (low < end) least = std::min(least, arc.border.at(low));
    }
    reach_ = least > 0 ? 1 / least : reach_;
  }

  std::vector<Arc> arcs_, next_;
  double reach_;
};

// Builds cells so that what two or three of them share is computed the same way for each.
class Builder {
 public:
  Builder(const std::vector<Nucleus>& nuclei, double rate, double tolerance, const PointGrid& grid)
      : nuclei_(nuclei), bound_(last_growth(rate)), near_(2 * cell_size(rate)), tolerance_(tolerance), grid_(grid) {}

  Ring cell(int own) const {
    const Nucleus& nucleus = nuclei_[own];
    Envelope envelope(std::max(bound_ - nucleus.head_start, 1e-9 * bound_) + 1e-6 * bound_);
    add_near(own, 0, near_, envelope);
    // A nucleus that cuts the cell is no farther than twice its reach and the other's lead.
    const double reach = 2 * envelope.reach() + nucleus.head_start;
    if (reach > near_) add_near(own, near_, reach, envelope);
    return outline(own, envelope);
  }

 private:
  // Nuclei whose distance is above `from`, up to `to`, the nearest first: the others then mostly reach nothing.
  void add_near(int own, double from, double to, Envelope& envelope) const {
    const Nucleus& nucleus = nuclei_[own];
    std::vector<std::pair<double, int>> others;
    grid_.each_near(nucleus.place, to, [&](int other, Point place) {
      const double away = length(place - nucleus.place);
      if (other != own && away > from) others.emplace_back(away, other);
      return true;
    });
    std::sort(others.begin(), others.end());
    for (const auto& [away, other] : others) envelope.add(other, border_between(nucleus, nuclei_[other]));
  }

  // Beginning at the first corner clockwise of x: which arc comes first, the envelope leaves to the last bit.
  Ring outline(int own, const Envelope& envelope) const {
    const auto& arcs = envelope.arcs();
    const std::size_t n = arcs.size();
    Ring corners;
    for (std::size_t k = 0; k < n; ++k) corners.push_back(corner(own, arcs[k > 0 ? k - 1 : n - 1], arcs[k]));
    const auto direction = [](const Envelope::Arc& arc) {
      return arc.begin - std::floor(arc.begin / (2 * kPi)) * 2 * kPi;
    };
    const auto first = std::min_element(arcs.begin(), arcs.end(), [&](const auto& one, const auto& other) {
      return direction(one) < direction(other);
    });
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = (static_cast<std::size_t>(first - arcs.begin()) + i) % n;
      ring.push_back(corners[k]);
      if (arcs[k].other != kFree)
        bend(own, arcs[k].other, corners[k], corners[k + 1 < n ? k + 1 : 0], ring);
      else
        bend_free(own, arcs[k], envelope.end_of(k), ring);
    }
    return ring;
  }

  Point on(int own, const Border& border, double angle) const {
    const SinCos turn = sin_cos(angle);
    return nuclei_[own].place + (1 / border.at(angle)) * Point{turn.cos, turn.sin};
  }

  // Where the cells of three nuclei meet: as the first of them sees it, whichever of them asks.
  Point corner(int own, const Envelope::Arc& before, const Envelope::Arc& after) const {
    const Point about = on(own, after.border, after.begin);
    if (before.other == kFree || after.other == kFree) return about;
    int trio[] = {own, before.other, after.other};
    std::sort(trio, trio + 3);
    const Border one = border_between(nuclei_[trio[0]], nuclei_[trio[1]]);
    const Border two = border_between(nuclei_[trio[0]], nuclei_[trio[2]]);
    double angles[2];
    if (trio[1] == trio[2] || !crossings(one, two, angles[0], angles[1])) return about;
    const Point p = on(trio[0], one, angles[0]), q = on(trio[0], one, angles[1]);
    return one.at(angles[0]) > 0 && !(one.at(angles[1]) > 0 && length(q - about) < length(p - about)) ? p : q;
  }

  // Appends what lies between two corners on the border of two nuclei, bent about the older one.
  void bend(int own, int other, Point from, Point to, Ring& ring) const {
    const auto age = [&](int i) { return std::pair(nuclei_[i].head_start, i); };
    const int old = age(own) < age(other) ? own : other, young = old == own ? other : own;
    const Border border = border_between(nuclei_[old], nuclei_[young]);
    const bool turned = std::pair(to.x, to.y) < std::pair(from.x, from.y);
    const Point first = turned ? to : from, last = turned ? from : to;
    const auto direction = [&](Point p) {
      return atan2_portable(p.y - nuclei_[old].place.y, p.x - nuclei_[old].place.x);
    };
    const double begin = direction(first);
    double sweep = direction(last) - begin;
    sweep -= 2 * kPi * std::round(sweep / (2 * kPi));
    const double chord = length(last - first);
    if (chord == 0) return;
    const double bow = std::abs(cross(on(old, border, begin + sweep / 2) - first, last - first)) / chord;
    const int pieces = std::clamp(static_cast<int>(std::ceil(std::sqrt(bow / tolerance_))), 1, 64);
    for (int k = 1; k < pieces; ++k) {
      const int step = turned ? pieces - k : k;
      ring.push_back(on(old, border, begin + sweep * step / pieces));
    }
  }

  void bend_free(int own, const Envelope::Arc& arc, double end, Ring& ring) const {
    constexpr int kPieces = 16;
    for (int k = 1; k < kPieces; ++k)
      ring.push_back(on(own, arc.border, arc.begin + (end - arc.begin) * k / kPieces));
  }

  const std::vector<Nucleus>& nuclei_;
  double bound_, near_, tolerance_;
  const PointGrid& grid_;
};

// Of a periodic window the nuclei and their copies about it.
std::vector<Nucleus> with_copies(const std::vector<Nucleus>& nuclei, const Window& window, double margin) {
  std::vector<Nucleus> all = nuclei;
  const Point size = window.size();
  const Window realm = window.grown(margin);
  const int across = static_cast<int>(std::ceil(margin / size.x)),
            down = static_cast<int>(std::ceil(margin / size.y));
  for (int j = -down; j <= down; ++j)
    for (int i = -across; i <= across; ++i)
      for (const Nucleus& nucleus : nuclei) {
        const Point copy = nucleus.place + Point{i * size.x, j * size.y};
        if ((i != 0 || j != 0) && realm.holds(copy)) all.push_back({copy, nucleus.head_start});
      }
  return all;
}

// Nuclei whose place no earlier one had covered, as they come.
class Growth {
 public:
  Growth(const Window& realm, double size)
      : realm_(realm),
        columns_(cells(realm.size().x, size)),
        rows_(cells(realm.size().y, size)),
        scale_{columns_ / realm.size().x, rows_ / realm.size().y},
        buckets_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  bool is_free(const Nucleus& next) const {
    const double reach = next.head_start;
    const auto from = [](double v, double scale) { return static_cast<int>(std::floor(v * scale)); };
    const Point p = next.place - realm_.low;
    for (int j = from(p.y - reach, scale_.y); j <= from(p.y + reach, scale_.y); ++j)
      for (int i = from(p.x - reach, scale_.x); i <= from(p.x + reach, scale_.x); ++i) {
        if (!realm_.periodic && (i < 0 || j < 0 || i >= columns_ || j >= rows_)) continue;
        const int turn_x = static_cast<int>(std::floor(static_cast<double>(i) / columns_));
        const int turn_y = static_cast<int>(std::floor(static_cast<double>(j) / rows_));
        const Point shift{turn_x * realm_.size().x, turn_y * realm_.size().y};
        for (const Nucleus& other : buckets_[(j - turn_y * rows_) * columns_ + (i - turn_x * columns_)])
          if (length(next.place - other.place - shift) <= reach - other.head_start) return false;
      }
    return true;
  }

  void take(const Nucleus& nucleus) {
    const Point p = nucleus.place - realm_.low;
    const int i = std::clamp(static_cast<int>(p.x * scale_.x), 0, columns_ - 1);
    const int j = std::clamp(static_cast<int>(p.y * scale_.y), 0, rows_ - 1);
    buckets_[j * columns_ + i].push_back(nucleus);
  }

 private:
  static int cells(double length, double size) { return static_cast<int>(std::clamp(length / size, 1.0, 8192.0)); }

  Window realm_;
  int columns_, rows_;
  Point scale_;
  std::vector<std::vector<Nucleus>> buckets_;
};

}  // namespace

std::vector<Nucleus> grow_nuclei(const Window& window, double rate, Rng& rng) {
  std::vector<Nucleus> grown;
  if (rate <= 0 || window.area() <= 0) return grown;
  const double last = last_growth(rate);
  const Window realm = window.periodic ? window : window.grown(last);
  std::vector<Nucleus> coming(static_cast<std::size_t>(draw_poisson(rate * realm.area() * last, rng)));
  for (Nucleus& nucleus : coming) {
    nucleus.place.x = rng.uniform(realm.low.x, realm.high.x);
    nucleus.place.y = rng.uniform(realm.low.y, realm.high.y);
    nucleus.head_start = rng.uniform(0, last);
  }
  std::stable_sort(coming.begin(), coming.end(),
                   [](const Nucleus& a, const Nucleus& b) { return a.head_start < b.head_start; });
  Growth growth(realm, cell_size(rate));
  for (const Nucleus& nucleus : coming) {
    if (!growth.is_free(nucleus)) continue;
    growth.take(nucleus);
    grown.push_back(nucleus);
  }
  return grown;
}

Result<Cells> johnson_mehl_cells(const std::vector<Nucleus>& nuclei, const Window& window, double rate,
                                 double tolerance, const RunContext& context) {
  Cells cells;
  if (nuclei.empty() || window.area() <= 0) return cells;
  const double last = last_growth(rate);
  const std::vector<Nucleus> all = window.periodic ? with_copies(nuclei, window, 3 * last) : nuclei;
  std::vector<Point> places;
  for (const Nucleus& nucleus : all) places.push_back(nucleus.place);
  const PointGrid grid(places, window.grown(3 * last), cell_size(rate));
  const Builder builder(all, rate, tolerance, grid);
  for (std::size_t i = 0; i < nuclei.size(); ++i) {
    if (i % 1024 == 0)
      if (auto go_on = context.check(); !go_on) return tl::unexpected<Status>(std::move(go_on.error()));
    Ring ring = builder.cell(static_cast<int>(i));
    if (ring.size() < 3) continue;  // between two neighbours, thinner than the tolerance: a chord of both
    if (window.periodic)
      cells.push_back(std::move(ring));
    else
      append_within(window, std::move(ring), cells);
  }
  return cells;
}

}  // namespace tessera::patterns

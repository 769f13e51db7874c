#include "tessera/tessellation/separate.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "tessera/base/portable_math.h"

namespace tessera {
namespace {

constexpr double kTouching = 0.02;    // of h: corners nearer than this are one
constexpr double kTinySide = 0.2;     // of h
constexpr double kCornerLoss = 0.06;  // of a stone's area: what cutting off a corner may cost

Point before(const Ring& ring, std::size_t i) { return ring[i > 0 ? i - 1 : ring.size() - 1]; }
Point after(const Ring& ring, std::size_t i) { return ring[i + 1 < ring.size() ? i + 1 : 0]; }

// Twice the area of the corner's triangle; negative for a hollow corner.
double corner_area2(const Ring& ring, std::size_t i) {
  return cross(ring[i] - before(ring, i), after(ring, i) - ring[i]);
}

// Cosine of the inner angle.
double corner_cosine(const Ring& ring, std::size_t i) {
  const Point a = before(ring, i) - ring[i], b = after(ring, i) - ring[i];
  const double size = length(a) * length(b);
  return size > 0 ? dot(a, b) / size : -1;
}

// Drops the corner that costs least, again and again, while `may_drop(corner, area of its triangle)`.
template <class MayDrop>
void drop_corners(Ring& ring, const MayDrop& may_drop) {
  while (ring.size() > 4) {
    double least = 1e30;
    std::size_t worst = ring.size();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double area = 0.5 * corner_area2(ring, i);
      if (may_drop(i, area) && std::fabs(area) < least) {
        least = std::fabs(area);
        worst = i;
      }
    }
    if (worst == ring.size()) return;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(worst));
  }
}

void drop_tiny_sides(Ring& ring, double shortest) {
  const double whole = std::fabs(signed_area(ring));
  drop_corners(ring, [&](std::size_t i, double area) {
    const double side = std::min(length(after(ring, i) - ring[i]), length(before(ring, i) - ring[i]));
    return side < shortest && area >= 0 && area <= kCornerLoss * whole;
  });
}

void drop_wide_corners(Ring& ring, double widest_deg) {
  const double cosine = sin_cos(widest_deg * kPi / 180).cos;
  const double whole = std::fabs(signed_area(ring));
  drop_corners(ring, [&](std::size_t i, double area) {
    return area >= -1e-9 * whole && area <= kCornerLoss * whole && corner_cosine(ring, i) <= cosine;
  });
}

bool is_outline(const Ring& ring) { return signed_area(ring) > 0 && is_simple(ring); }

// Neighbours in one place are one corner.
void merge_touching(Ring& ring, double shortest) {
  for (std::size_t i = 0; i < ring.size() && ring.size() > 1;) {
    if (length(after(ring, i) - ring[i]) < shortest) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

// A stone has four corners; a triangle's fourth is in the middle of its longest side.
void complete_triangle(Ring& ring) {
  if (ring.size() != 3) return;
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (length(after(ring, i) - ring[i]) > length(after(ring, longest) - ring[longest])) longest = i;
  const Point middle = 0.5 * (ring[longest] + after(ring, longest));
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(longest) + 1, middle);
}

Ring without(const Ring& ring, std::size_t i) {
  Ring rest = ring;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
  return rest;
}

// Where a frontier folds upon itself within a pixel or two: leaves out vertices until an outline is left, first those
// that alone are to blame, of these the one that matters least. Empty where there is none.
Ring unfolded(Ring ring) {
  while (!is_outline(ring) && ring.size() > 3) {
    std::size_t worst = 0;
    bool mends = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const bool mends_too = is_outline(without(ring, i));
      const bool smaller = std::fabs(corner_area2(ring, i)) < std::fabs(corner_area2(ring, worst));
      if (mends_too > mends || (mends_too == mends && smaller)) worst = i;
      mends |= mends_too;
    }
    ring = without(ring, worst);
  }
  return is_outline(ring) ? ring : Ring{};
}

// A thread's memory to work in; to get some for each piece, threads would have to queue.
struct Scratch {
  Ring corners, whole;
};

// The corners if they make an outline, else all vertices, unfolded if need be.
Ring first_outline(Scratch& scratch, double half_side) {
  if (is_outline(scratch.corners)) return scratch.corners;
  merge_touching(scratch.whole, kTouching * half_side);
  return unfolded(scratch.whole);
}

Ring separate_piece(const Tessellation& t, const std::vector<char>& flat, int cell, double widest_deg,
                    Scratch& scratch) {
  const double half_side = t.half_side[cell];
  scratch.corners.clear();
  scratch.whole.clear();
  for (int slot = t.map.first[cell]; slot < t.map.first[cell + 1]; ++slot) {
    scratch.whole.push_back(t.map.at(slot));
    if (!flat[slot]) scratch.corners.push_back(t.map.at(slot));
  }
  merge_touching(scratch.corners, kTouching * half_side);
  drop_tiny_sides(scratch.corners, kTinySide * half_side);
  drop_wide_corners(scratch.corners, widest_deg);
  Ring piece = first_outline(scratch, half_side);
  complete_triangle(piece);
  return piece;
}

}  // namespace

std::vector<Ring> separate_pieces(const Tessellation& t, const std::vector<char>& flat, double wide_angle) {
  std::vector<Ring> pieces(t.cells());
  cv::parallel_for_({0, t.cells()}, [&](const cv::Range& range) {
    Scratch scratch;
    for (int cell = range.start; cell < range.end; ++cell)
      pieces[cell] = separate_piece(t, flat, cell, wide_angle, scratch);
  });
  return pieces;
}

Ring rounded_outline(const Ring& ring, double parts) {
  Ring rounded;
  for (const Point p : ring) rounded.push_back({std::round(p.x * parts) / parts, std::round(p.y * parts) / parts});
  if (is_outline(rounded)) return rounded;
  merge_touching(rounded, 0.5 / parts);
  rounded = unfolded(std::move(rounded));
  if (ring.size() > 3) complete_triangle(rounded);
  return rounded;
}

void shrink(Ring& ring, double grout, double half_side) {
  const double girth = perimeter(ring);
  if (girth <= 0) return;
  // Half the width of a stone, as that of a square with its area and perimeter.
  const double half_width = 2 * std::fabs(signed_area(ring)) / girth;
  const double size = std::min(1.0, half_width / (0.75 * half_side));
  const double by = 0.5 * grout * size * size;
  const Point centre = centroid(ring);
  const Ring whole = ring;
  for (Point& p : ring) {
    const Point way = centre - p;
    const double distance = length(way);
    if (distance > 0) p += (std::min(by, 0.45 * distance) / distance) * way;
  }
  if (!is_simple(ring)) ring = whole;  // a hollow stone's centre may lie outside it
}

}  // namespace tessera

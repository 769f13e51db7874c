#include "tessera/parquetry/morphing_grid.h"

#include <algorithm>
#include <cmath>

namespace tessera::parquetry {
namespace {

constexpr double kDamping = 9;       // gamma, for m = 1
constexpr double kTime = 0.06;       // a step; much below gamma over the stiffness of springs and edges together
constexpr double kPinnedWay = 0.05;  // of a cell's side, that a pinned vertex goes in a step at most
constexpr double kAtRest = 1e-4;     // of a cell's side
constexpr int kFirstSteps = 9;       // in which nothing moves yet
constexpr int kMostSteps = 400;
constexpr double kSpare = 1.1;  // curves take some room beside straight sides
constexpr double kSharpest = 0.5735764363510461, kBluntest = -0.8660254037844387;  // cosines of 55, 150 degrees

}  // namespace

MorphingGrid::MorphingGrid(const Grid& grid, const EdgePicture& edges, double weight, double least_width)
    : across_(grid.across()), down_(grid.down()), edges_(edges), weight_(weight) {
  double narrowest = grid.columns.back() + grid.rows.back();
  for (int row = 0; row <= down_; ++row)
    for (int column = 0; column <= across_; ++column) {
      vertices_.push_back({static_cast<double>(grid.columns[column]), static_cast<double>(grid.rows[row])});
      if (column < across_ && row < down_) {
        const cv::Rect cell = grid.cell(column, row);
        narrowest = std::min<double>(narrowest, std::min(cell.width, cell.height));
      }
    }
  velocities_.resize(vertices_.size());
  holds_.resize(vertices_.size());
  side_ = std::sqrt(static_cast<double>(grid.columns.back()) * grid.rows.back() / (across_ * down_));
  least_radius_ = std::min(0.5 * kSpare * least_width, 0.499 * narrowest);
}

void MorphingGrid::pin(const Pin& pin) {
  const int i = index(pin.column, pin.row);
  holds_[i] = {true, vertices_[i] + allowed(pin.column, pin.row, pin.at - vertices_[i])};
  wake();
}

void MorphingGrid::unpin(int column, int row) {
  holds_[index(column, row)] = {};
  wake();
}

void MorphingGrid::wake() {
  steps_ = 0;
  at_rest_ = false;
}

std::vector<Pin> MorphingGrid::pins() const {
  std::vector<Pin> pins;
  for (int i = 0; i < static_cast<int>(holds_.size()); ++i)
    if (holds_[i].pinned) pins.push_back({i % (across_ + 1), i / (across_ + 1), holds_[i].at});
  return pins;
}

bool MorphingGrid::is_in_place(const Pin& pin) const { return vertex(pin.column, pin.row) == pin.at; }

Point MorphingGrid::allowed(int column, int row, Point way) const {
  if (column == 0 || column == across_) way.x = 0;
  if (row == 0 || row == down_) way.y = 0;
  return way;
}

// Eq. 7, cells of side 1: springs to the eight neighbours, damping, and downhill in the potential.
Point MorphingGrid::force(int column, int row) const {
  const int i = index(column, row);
  Point springs;
  for (int r = std::max(0, row - 1); r <= std::min(down_, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(across_, column + 1); ++c)
      springs += vertices_[index(c, r)] - vertices_[i];
  return (1 / side_) * springs - kDamping * velocities_[i] + weight_ * edges_.downhill(vertices_[i]);
}

bool MorphingGrid::is_sound(int column, int row) const {
  const Point corners[] = {vertex(column, row), vertex(column + 1, row), vertex(column + 1, row + 1),
                           vertex(column, row + 1)};
  const Point middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  double sizes[4], taken[4];  // what a disc in a corner takes of its sides, in radii: cot(angle / 2)
  for (int i = 0; i < 4; ++i) {
    const Point side = corners[(i + 1) % 4] - corners[i], back = corners[(i + 3) % 4] - corners[i];
    sizes[i] = length(side);
    const double both = sizes[i] * length(back), cosine = dot(side, back), sine = cross(side, back);
    if (!(sine > 0) || cosine > kSharpest * both || cosine < kBluntest * both) return false;
    if (cross(side, middle - corners[i]) < least_radius_ * sizes[i]) return false;
    taken[i] = (both + cosine) / sine;
  }
  // A disc that rolls along a side reaches both its corners: no end is too narrow for it.
  for (int i = 0; i < 4; ++i)
    if (sizes[i] < least_radius_ * (taken[i] + taken[(i + 1) % 4])) return false;
  return true;
}

bool MorphingGrid::are_sound_around(int column, int row) const {
  for (int r = std::max(0, row - 1); r <= std::min(down_ - 1, row); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(across_ - 1, column); ++c)
      if (!is_sound(c, r)) return false;
  return true;
}

// As much of the way as the cells allow; 0 where that is none.
double MorphingGrid::move(int column, int row, Point way) {
  Point& vertex = vertices_[index(column, row)];
  const Point before = vertex;
  for (const double share : {1.0, 0.5, 0.25}) {
    vertex = before + share * way;
    if (are_sound_around(column, row)) return share;
  }
  vertex = before;
  return 0;
}

void MorphingGrid::step() {
  std::vector<Point> forces;
  for (int row = 0; row <= down_; ++row)
    for (int column = 0; column <= across_; ++column) forces.push_back(allowed(column, row, force(column, row)));
  double farthest = 0;
  for (int row = 0; row <= down_; ++row)
    for (int column = 0; column <= across_; ++column) {
      const int i = index(column, row);
      const Point before = vertices_[i];
      if (holds_[i].pinned) {
        const Point way = holds_[i].at - before;
        const double most = kPinnedWay * side_, size = length(way);
        if (size > most)
          move(column, row, (most / size) * way);
        else if (move(column, row, way) == 1)
          vertices_[i] = holds_[i].at;
        velocities_[i] = {};
      } else {
        const double share = move(column, row, (kTime * side_) * velocities_[i]);
        velocities_[i] = share * velocities_[i] + kTime * forces[i];
      }
      farthest = std::max(farthest, length(vertices_[i] - before));
    }
  ++steps_;
  at_rest_ = steps_ >= kMostSteps || (steps_ > kFirstSteps && farthest < kAtRest * side_);
}

void MorphingGrid::settle() {
  while (!at_rest_) step();
}

}  // namespace tessera::parquetry

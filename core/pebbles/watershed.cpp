#include "tessera/pebbles/watershed.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tessera::pebbles {
namespace {

// A picture with a wall of one pixel around it, so that no neighbour has to be asked whether it exists.
class Immersion {
 public:
  Immersion(const cv::Mat1w& strength, int depth)
      : width_(strength.cols + 2), rows_(strength.rows), columns_(strength.cols), depth_(depth) {
    strength_.assign(static_cast<std::size_t>(width_) * (rows_ + 2), 0);
    basin_.assign(strength_.size(), kWall);
    for (int y = 0; y < rows_; ++y) {
      std::copy_n(strength[y], columns_, &strength_[at(y, 0)]);
      std::fill_n(&basin_[at(y, 0)], columns_, kDry);
    }
  }

  void flood() {
    const std::vector<int> order = lowest_first();
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      const int level = strength_[order[begin]];
      while (end < order.size() && strength_[order[end]] == level) ++end;
      // What touches water first, then inwards; what is left are new valleys.
      for (std::size_t k = begin; k < end; ++k)
        if (basin_[order[k]] == kDry && touches_water(order[k])) wet(order[k], level);
      spread(level);
      for (std::size_t k = begin; k < end; ++k) {
        if (basin_[order[k]] != kDry) continue;
        parent_.push_back(static_cast<int>(parent_.size()));
        lowest_.push_back(level);
        basin_[order[k]] = parent_.back();
        queue_.push_back(order[k]);
        spread(level);
      }
    }
  }

  Basins basins() {
    Basins out{cv::Mat1i(rows_, columns_), 0};
    std::vector<int> number(parent_.size(), -1);
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        int& n = number[root(basin_[at(y, x)])];
        if (n < 0) n = out.count++;
        out.labels(y, x) = n;
      }
    return out;
  }

 private:
  static constexpr int kDry = -1, kWall = -2;

  std::size_t at(int y, int x) const { return static_cast<std::size_t>(y + 1) * width_ + x + 1; }

  // Pixels in the order of their strengths.
  std::vector<int> lowest_first() const {
    std::vector<int> start(65537, 0);
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) ++start[strength_[at(y, x)] + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<int> order(static_cast<std::size_t>(rows_) * columns_);
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) order[start[strength_[at(y, x)]]++] = static_cast<int>(at(y, x));
    return order;
  }

  std::array<int, 4> neighbours(int pixel) const { return {pixel - width_, pixel - 1, pixel + 1, pixel + width_}; }

  int root(int basin) {
    while (parent_[basin] != basin) basin = parent_[basin] = parent_[parent_[basin]];
    return basin;
  }

  bool touches_water(int pixel) const {
    const auto around = neighbours(pixel);
    return std::any_of(around.begin(), around.end(), [this](int n) { return basin_[n] >= 0; });
  }

  // Gives a pixel to a neighbour's basin, and joins the basins that meet there.
  void wet(int pixel, int level) {
    int own = kDry;
    for (const int n : neighbours(pixel)) {
      if (basin_[n] < 0) continue;
      const int other = root(basin_[n]);
      if (own == kDry) {
        own = other;
      } else if (other != own) {
        const int low = lowest_[own] <= lowest_[other] ? own : other, high = low == own ? other : own;
        if (level - lowest_[high] >= depth_) continue;
        parent_[high] = low;
        own = low;
      }
    }
    basin_[pixel] = own;
    queue_.push_back(pixel);
  }

  void spread(int level) {
    for (std::size_t k = 0; k < queue_.size(); ++k)
      for (const int n : neighbours(queue_[k]))
        if (basin_[n] == kDry && strength_[n] == level) wet(n, level);
    queue_.clear();
  }

  int width_, rows_, columns_, depth_;
  std::vector<std::uint16_t> strength_;
  std::vector<int> basin_;   // of each pixel
  std::vector<int> parent_;  // of each basin: itself, or the one it has flowed into
  std::vector<int> lowest_;  // level of each basin
  std::vector<int> queue_;
};

}  // namespace

Basins watershed(const cv::Mat1w& strength, int depth) {
  Immersion immersion(strength, depth);
  immersion.flood();
  return immersion.basins();
}

}  // namespace tessera::pebbles

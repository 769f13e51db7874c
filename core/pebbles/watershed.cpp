#include "tessera/pebbles/watershed.h"

#include <cstdint>
#include <numeric>
#include <vector>

namespace tessera::pebbles {
namespace {

// Pixel indices in the order of their strengths.
std::vector<int> lowest_first(const cv::Mat1w& strength) {
  std::vector<int> start(65537, 0);
  for (const std::uint16_t s : strength) ++start[s + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<int> order(strength.total());
  int pixel = 0;
  for (const std::uint16_t s : strength) order[start[s]++] = pixel++;
  return order;
}

class Immersion {
 public:
  Immersion(const cv::Mat1w& strength, int depth)
      : width_(strength.cols), height_(strength.rows), depth_(depth), strength_(strength.ptr<std::uint16_t>()) {
    basin_.assign(strength.total(), kDry);
  }

  void flood(const std::vector<int>& order) {
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      const int level = strength_[order[begin]];
      while (end < order.size() && strength_[order[end]] == level) ++end;
      // What touches water first, then inwards; what is left are new valleys.
      for (std::size_t k = begin; k < end; ++k)
        if (basin_[order[k]] == kDry && wet_neighbour(order[k]) != kDry) wet(order[k], level);
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
    Basins out{cv::Mat1i(height_, width_), 0};
    std::vector<int> number(parent_.size(), -1);
    int* label = out.labels.ptr<int>();
    for (std::size_t p = 0; p < basin_.size(); ++p) {
      int& n = number[root(basin_[p])];
      if (n < 0) n = out.count++;
      label[p] = n;
    }
    return out;
  }

 private:
  static constexpr int kDry = -1;

  template <class Visit>
  void each_neighbour(int pixel, Visit&& visit) const {
    const int x = pixel % width_;
    if (pixel >= width_) visit(pixel - width_);
    if (x > 0) visit(pixel - 1);
    if (x + 1 < width_) visit(pixel + 1);
    if (pixel + width_ < width_ * height_) visit(pixel + width_);
  }

  int root(int basin) {
    while (parent_[basin] != basin) basin = parent_[basin] = parent_[parent_[basin]];
    return basin;
  }

  int wet_neighbour(int pixel) const {
    int found = kDry;
    each_neighbour(pixel, [&](int n) {
      if (found == kDry) found = basin_[n];
    });
    return found;
  }

  // Gives a pixel to a neighbour's basin, and joins the basins that meet there.
  void wet(int pixel, int level) {
    int own = kDry;
    each_neighbour(pixel, [&](int n) {
      if (basin_[n] == kDry) return;
      const int other = root(basin_[n]);
      if (own == kDry) {
        own = other;
      } else if (other != own) {
        const int low = lowest_[own] <= lowest_[other] ? own : other, high = low == own ? other : own;
        if (level - lowest_[high] >= depth_) return;
        parent_[high] = low;
        own = low;
      }
    });
    basin_[pixel] = own;
    queue_.push_back(pixel);
  }

  void spread(int level) {
    for (std::size_t k = 0; k < queue_.size(); ++k)
      each_neighbour(queue_[k], [&](int n) {
        if (basin_[n] == kDry && strength_[n] == level) wet(n, level);
      });
    queue_.clear();
  }

  int width_, height_, depth_;
  const std::uint16_t* strength_;
  std::vector<int> basin_;   // of each pixel
  std::vector<int> parent_;  // of each basin: itself, or the one it has flowed into
  std::vector<int> lowest_;  // level of each basin
  std::vector<int> queue_;
};

}  // namespace

Basins watershed(const cv::Mat1w& strength, int depth) {
  Immersion immersion(strength, depth);
  immersion.flood(lowest_first(strength));
  return immersion.basins();
}

}  // namespace tessera::pebbles

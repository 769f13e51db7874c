#include "tessera/parquetry/regions.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "tessera/voronoi/trace.h"

namespace tessera::parquetry {
namespace {

constexpr int kGiven = -1;  // the label of what has been cut off

struct Extent {
  cv::Rect box;
  std::int64_t pixels = 0, x = 0, y = 0;  // sums
};

std::vector<Extent> extents_of(const Regions& regions) {
  std::vector<Extent> extents(regions.count);
  for (int y = 0; y < regions.labels.rows; ++y)
    for (int x = 0; x < regions.labels.cols; ++x) {
      Extent& extent = extents[regions.labels(y, x)];
      extent.box |= cv::Rect(x, y, 1, 1);
      ++extent.pixels, extent.x += x, extent.y += y;
    }
  return extents;
}

struct Border {
  int region, neighbour, length;
};

// Both ways, by region and neighbour.
std::vector<Border> borders_of(const Regions& regions) {
  std::vector<std::pair<int, int>> sides;
  const auto look = [&](int a, int b) {
    if (a == b) return;
    sides.emplace_back(a, b);
    sides.emplace_back(b, a);
  };
  const LabelMap& labels = regions.labels;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      if (x + 1 < labels.cols) look(labels(y, x), labels(y, x + 1));
      if (y + 1 < labels.rows) look(labels(y, x), labels(y + 1, x));
    }
  std::sort(sides.begin(), sides.end());
  std::vector<Border> borders;
  for (const auto& [region, neighbour] : sides) {
    if (borders.empty() || borders.back().region != region || borders.back().neighbour != neighbour)
      borders.push_back({region, neighbour, 0});
    ++borders.back().length;
  }
  return borders;
}

bool is_wide(cv::Rect box) { return box.width >= box.height; }

// Across the longer side of a region's bounds.
struct Cut {
  int region;
  int at;  // the first pixel behind it, along that side
};

Regions cut(const Regions& regions, const std::vector<Extent>& extents, const std::vector<Cut>& cuts) {
  cv::Mat1i values = regions.labels.clone();
  for (const Cut& way : cuts) {
    const cv::Rect box = extents[way.region].box;
    const int begin = is_wide(box) ? box.x : box.y, end = begin + std::max(box.width, box.height);
    const int at = std::clamp(way.at, begin + 1, end - 1);
    for (int y = box.y; y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x)
        if (regions.labels(y, x) == way.region && (is_wide(box) ? x : y) >= at)
          values(y, x) = regions.count + way.region;
  }
  return regions_of(values);
}

// Bounds of the holes of each region that has some.
std::map<int, std::vector<cv::Rect>> holes_of(const Regions& regions) {
  const CellGraph graph = trace_cells_and_islands(regions.labels, regions.count);
  const auto walks = cell_walks(graph, regions.count);
  std::map<int, std::vector<cv::Rect>> holes;
  for (int region = 0; region < regions.count; ++region) {
    if (walks[region].size() < 2) continue;
    std::vector<cv::Rect> boxes;
    for (const std::vector<int>& walk : walks[region]) {
      std::vector<cv::Point> corners;
      for (const int h : walk)
        for (const cv::Point corner : walk_arc(graph, regions.labels, h >> 1)) corners.push_back(corner);
      boxes.push_back(cv::boundingRect(corners));
    }
    // The walk around the region itself has the largest bounds.
    boxes.erase(std::max_element(boxes.begin(), boxes.end(),
                                 [](const cv::Rect& a, const cv::Rect& b) { return a.area() < b.area(); }));
    holes[region] = std::move(boxes);
  }
  return holes;
}

// ---- Widths

// A region in its box, with a pixel around it that is none of its; depths from its sides, half a pixel too small at
// most.
cv::Mat1f depth_of(const Regions& regions, int region, cv::Rect box) {
  cv::Mat1b inside(box.height + 2, box.width + 2, static_cast<std::uint8_t>(0));
  inside(cv::Rect(1, 1, box.width, box.height)).setTo(255, regions.labels(box) == region);
  cv::Mat1f depth;
  cv::distanceTransform(inside, depth, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return depth(cv::Rect(1, 1, box.width, box.height));
}

std::vector<char> too_narrow(const Regions& regions, double width) {
  const std::vector<Extent> extents = extents_of(regions);
  std::vector<char> narrow(regions.count);
  cv::parallel_for_({0, regions.count}, [&](const cv::Range& range) {
    for (int region = range.start; region < range.end; ++region) {
      const cv::Rect box = extents[region].box;
      narrow[region] = std::min(box.width, box.height) < width ||
                       cv::countNonZero(depth_of(regions, region, box) >= width / 2) == 0;
    }
  });
  return narrow;
}

// The nearest pixel's number, of those that have one above 0; `numbers` has one at least.
cv::Mat1i nearest_number(const cv::Mat1i& numbers) {
  cv::Mat1f distance;
  cv::Mat1i pixel;
  cv::distanceTransform(numbers <= 0, distance, pixel, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<int> number(1, 0);
  for (int y = 0; y < numbers.rows; ++y)
    for (int x = 0; x < numbers.cols; ++x)
      if (numbers(y, x) > 0) {
        number.resize(std::max<std::size_t>(number.size(), pixel(y, x) + 1), 0);
        number[pixel(y, x)] = numbers(y, x);
      }
  for (int& p : pixel) p = number[p];
  return pixel;
}

// What a region falls into: 1, 2, ... in its box; kGiven where it is cut off, 0 outside.
struct Parts {
  cv::Mat1i numbers;
  int count = 1;
  bool same = true;  // it is one, all of it
};

Parts parts_of(const Regions& regions, int region, cv::Rect box, double width) {
  constexpr double kCorner = 1.1;  // radii squared: what the disc misses in a corner of 48 degrees
  const double radius = width / 2;
  const cv::Mat1b inside = regions.labels(box) == region;
  const cv::Mat1f depth = depth_of(regions, region, box);
  // Cores that are deep enough for the disc somewhere; a pixel less deep, they hang together as the disc's ways do.
  Parts parts;
  cv::Mat1i cores;
  const int found = cv::connectedComponents(depth > radius - 1, cores, 8, CV_32S);
  std::vector<int> number(found, 0);
  parts.count = 0;
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x)
      if (cores(y, x) > 0 && depth(y, x) >= radius && number[cores(y, x)] == 0) number[cores(y, x)] = ++parts.count;
  for (int& core : cores) core = number[core];
  if (parts.count == 0) {
    parts.numbers = cv::Mat1i(box.size(), 0);
    parts.numbers.setTo(kGiven, inside);
    parts.same = false;
    return parts;
  }
  cv::Mat1f distance;
  cv::distanceTransform(cores == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat1b missed = inside & (distance > radius);
  cv::Mat1i rest;
  cv::Mat stats, centroids;
  const int rests = cv::connectedComponentsWithStats(missed, rest, stats, centroids, 4, CV_32S);
  std::vector<bool> given(rests, false);
  for (int i = 1; i < rests; ++i) given[i] = stats.at<int>(i, cv::CC_STAT_AREA) > kCorner * radius * radius;
  parts.same = parts.count == 1 && std::count(given.begin(), given.end(), true) == 0;
  if (parts.same) return parts;
  parts.numbers = nearest_number(cores);
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      if (!inside(y, x)) parts.numbers(y, x) = 0;
      if (given[rest(y, x)]) parts.numbers(y, x) = kGiven;
    }
  return parts;
}

// Steps 2 and 3 of widened(); false where there was nothing to do.
bool cut_thin_parts(Regions& regions, double width) {
  const std::vector<Extent> extents = extents_of(regions);
  std::vector<Parts> parts(regions.count);
  cv::parallel_for_({0, regions.count}, [&](const cv::Range& range) {
    for (int region = range.start; region < range.end; ++region)
      parts[region] = parts_of(regions, region, extents[region].box, width);
  });
  cv::Mat1i numbers = regions.labels + 1;
  int next = regions.count;
  bool changed = false, left = false;
  for (int region = 0; region < regions.count; ++region) {
    if (parts[region].same) {
      left = true;
      continue;
    }
    changed = true;
    left = left || parts[region].count > 0;
    const cv::Rect box = extents[region].box;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        const int part = parts[region].numbers(y, x);
        if (part == kGiven) numbers(box.y + y, box.x + x) = 0;
        if (part > 1) numbers(box.y + y, box.x + x) = next + part - 1;
      }
    next += std::max(0, parts[region].count - 1);
  }
  if (!changed || !left) return false;
  regions = regions_of(nearest_number(numbers));
  return true;
}

// Those of at most `pixels`.
void join_narrow(Regions& regions, double width, double pixels) {
  for (;;) {
    std::vector<char> narrow = too_narrow(regions, width);
    const std::vector<Extent> extents = extents_of(regions);
    for (int region = 0; region < regions.count; ++region)
      if (static_cast<double>(extents[region].pixels) > pixels) narrow[region] = 0;
    if (regions.count == 1 || std::count(narrow.begin(), narrow.end(), 1) == 0) return;
    regions = joined(regions, narrow);
  }
}

}  // namespace

Regions regions_of(const cv::Mat1i& values) {
  // Runs that touch are joined; the root of each set is its first pixel.
  std::vector<int> parent(values.total());
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const int width = values.cols;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = y * width + x;
      parent[i] = i;
      if (x > 0 && values(y, x) == values(y, x - 1)) parent[i] = root(i - 1);
      if (y > 0 && values(y, x) == values(y - 1, x)) {
        const int a = root(i), b = root(i - width);
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
  Regions regions{LabelMap(values.size()), 0};
  for (int i = 0; i < static_cast<int>(parent.size()); ++i) {
    const int first = root(i);
    regions.labels(i / width, i % width) =
        first == i ? regions.count++ : regions.labels(first / width, first % width);
  }
  return regions;
}

Regions split_large(Regions regions, double most) {
  for (;;) {
    const std::vector<Extent> extents = extents_of(regions);
    std::vector<Cut> cuts;
    for (int region = 0; region < regions.count; ++region) {
      const Extent& extent = extents[region];
      if (std::max(extent.box.width, extent.box.height) <= std::max(1.0, most)) continue;
      const std::int64_t sum = is_wide(extent.box) ? extent.x : extent.y;
      cuts.push_back({region, static_cast<int>((2 * sum / extent.pixels + 1) / 2)});
    }
    if (cuts.empty()) return regions;
    regions = cut(regions, extents, cuts);
  }
}

Regions without_holes(Regions regions) {
  constexpr int kRounds = 64;  // each halves the holes of a region
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Extent> extents = extents_of(regions);
    std::vector<Cut> cuts;
    for (const auto& [region, holes] : holes_of(regions)) {
      std::vector<int> middles;
      for (const cv::Rect& hole : holes)
        middles.push_back(is_wide(extents[region].box) ? hole.x + (hole.width + 1) / 2
                                                       : hole.y + (hole.height + 1) / 2);
      std::sort(middles.begin(), middles.end());
      cuts.push_back({region, middles[middles.size() / 2]});
    }
    if (cuts.empty()) break;
    regions = cut(regions, extents, cuts);
  }
  return regions;
}

Regions joined(const Regions& regions, const std::vector<char>& marked) {
  const std::vector<Extent> extents = extents_of(regions);
  const std::vector<Border> borders = borders_of(regions);
  std::vector<int> order;
  for (int region = 0; region < regions.count; ++region)
    if (marked[region]) order.push_back(region);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return extents[a].pixels < extents[b].pixels; });
  std::vector<int> parent(regions.count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int region) {
    while (parent[region] != region) region = parent[region];
    return region;
  };
  std::vector<bool> touched(regions.count, false);
  for (const int region : order) {
    if (touched[region]) continue;
    auto border = std::lower_bound(borders.begin(), borders.end(), region,
                                   [](const Border& b, int wanted) { return b.region < wanted; });
    const Border* longest = nullptr;
    for (; border != borders.end() && border->region == region; ++border)
      if (!longest || border->length > longest->length) longest = &*border;
    if (!longest) continue;
    touched[region] = touched[longest->neighbour] = true;
    parent[root(region)] = root(longest->neighbour);
  }
  cv::Mat1i values = regions.labels.clone();
  for (int& value : values) value = root(value);
  return regions_of(values);
}

Regions widened(Regions regions, double width) {
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    join_narrow(regions, width, width * width);
    if (!cut_thin_parts(regions, width)) break;
  }
  join_narrow(regions, width, static_cast<double>(regions.labels.total()));
  return regions;
}

}  // namespace tessera::parquetry

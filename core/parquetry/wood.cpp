#include "tessera/parquetry/wood.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tessera/geometry/scan.h"
#include "tessera/parquetry/shape.h"
#include "tessera/parquetry/spacing.h"

namespace tessera::parquetry {
namespace {

// Positions of a group are 1.5 px across and down from its middle at most.
constexpr double kGroupReach = 1.5 * 1.4142135623730951 + 1e-6;

std::uint8_t rounded_up(double distance) { return static_cast<std::uint8_t>(std::min(255.0, std::ceil(distance))); }

Point group_middle(int x, int y) { return {kGroup * x + 1.5, kGroup * y + 1.5}; }

std::vector<Span> group_spans(const Turn& turn) {
  const std::vector<Span> rows = turn.spans();
  std::vector<Span> groups((rows.size() + kGroup - 1) / kGroup);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Span span{turn.size().width, 0};
    for (std::size_t y = g * kGroup; y < std::min(rows.size(), (g + 1) * kGroup); ++y)
      if (rows[y].begin < rows[y].end) span = {std::min(span.begin, rows[y].begin), std::max(span.end, rows[y].end)};
    if (span.begin < span.end) groups[g] = {span.begin / kGroup, (span.end + kGroup - 1) / kGroup};
  }
  return groups;
}

}  // namespace

cv::Mat1f depth_of(const cv::Mat1b& mask) {
  cv::Mat1b framed;
  cv::copyMakeBorder(mask, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::Mat1f depth;
  cv::distanceTransform(framed, depth, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return depth(cv::Rect({1, 1}, mask.size()));  // no copy: it takes 4 bytes a pixel
}

std::vector<View> views_of(const std::vector<Panel>& panels, const Params& params) {
  std::vector<View> views;
  for (int panel = 0; panel < static_cast<int>(panels.size()); ++panel)
    for (const int rotation : allowed_rotations(params)) {
      const Turn turn(panels[panel].scan.size(), degrees_of(rotation, params));
      views.push_back({panel, rotation, turn, group_spans(turn)});
    }
  return views;
}

Wood::Wood(const std::vector<Panel>& panels, const std::vector<View>& views, double clearance, double reach)
    : views_(views), clearance_(clearance), reach_(reach) {
  for (const Panel& panel : panels) measure_depth(panel, sheets_.emplace_back());
  room_.resize(views.size());
  cv::parallel_for_({0, static_cast<int>(views.size())}, [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      const std::vector<Span>& groups = views_[v].groups;
      room_[v] = Rows(groups, 1, views_[v].turn.size().width / kGroup + 1);
      for (int y = 0; y < static_cast<int>(groups.size()); ++y)
        for (int x = groups[y].begin; x < groups[y].end; ++x)
          *room_[v].at(y, x) = bare_room(sheets_[views_[v].panel], views_[v].turn, x, y);
    }
  });
}

void Wood::measure_depth(const Panel& panel, Sheet& sheet) const {
  sheet.size = panel.mask.size();
  sheet.mask = panel.mask;
  sheet.depth = depth_of(panel.mask);
  sheet.missing = cv::Mat1w(sheet.size.height, sheet.size.width + 1, std::uint16_t{0});
  for (int y = 0; y < sheet.size.height; ++y)
    for (int x = 0; x < sheet.size.width; ++x)
      sheet.missing(y, x + 1) = static_cast<std::uint16_t>(sheet.missing(y, x) + (panel.mask(y, x) == 0 ? 1 : 0));
  sheet.columns = sheet.size.width / kBin + 1;
  sheet.rows = sheet.size.height / kBin + 1;
  sheet.rims.resize(static_cast<std::size_t>(sheet.columns) * sheet.rows);
  sheet.cuts.resize(sheet.rims.size());
  cv::Mat1b wider;
  cv::dilate(panel.mask, wider, cv::Mat());
  for (int y = 0; y < sheet.size.height; ++y)
    for (int x = 0; x < sheet.size.width; ++x)
      if (panel.mask(y, x) == 0 && wider(y, x) != 0)
        sheet.rims[y / kBin * sheet.columns + x / kBin].emplace_back(x, y);
}

template <class Visit>
void Wood::each_bin(const Sheet& sheet, const Ring& ring, double margin, const Visit& visit) const {
  const Bounds box = bounds_of(ring);
  const auto bin = [](double v, int count) {
    return std::clamp(static_cast<int>(std::floor(v / kBin)), 0, count - 1);
  };
  const int left = bin(box.low.x - margin, sheet.columns), right = bin(box.high.x + margin, sheet.columns);
  const int top = bin(box.low.y - margin, sheet.rows), bottom = bin(box.high.y + margin, sheet.rows);
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) visit(y * sheet.columns + x);
}

// A place is within half a diagonal of its pixel's middle, the panel's side half a pixel nearer than the middles
// beyond.
Wood::Way Wood::along(const Sheet& sheet, const Ring& cut, double apart) const {
  constexpr double kStep = 2;
  const auto pixel = [](double v, int size) { return std::clamp(static_cast<int>(v), 0, size - 1); };
  bool sure = true;
  Point a = cut.back();
  for (const Point b : cut) {
    const double side = length(b - a);
    for (double at = 0; at < side;) {
      const Point p = a + (at / side) * (b - a);
      const double depth = sheet.depth(pixel(p.y, sheet.size.height), pixel(p.x, sheet.size.width));
      if (depth < clearance_ + 0.5 - kHalfDiagonal - 1e-3) return Way::kBlocked;
      const double room = depth - kHalfDiagonal - apart - 1e-3;
      if (room < kStep) sure = false;  // what lies between is not known
      at += std::max(room, kStep);
    }
    a = b;
  }
  return sure ? Way::kFree : Way::kUnsure;
}

bool Wood::is_wood_inside(const Sheet& sheet, const Ring& cut) const {
  bool wood = true;
  each_run(cut, sheet.size.width, sheet.size.height,
           [&](int y, int begin, int end) { wood = wood && sheet.missing(y, end) == sheet.missing(y, begin); });
  return wood;
}

bool Wood::on_wood(int panel, const Ring& cut) const {
  const Sheet& sheet = sheets_[panel];
  const Bounds box = bounds_of(cut);
  if (box.low.x < clearance_ || box.low.y < clearance_ || box.high.x > sheet.size.width - clearance_ ||
      box.high.y > sheet.size.height - clearance_)
    return false;
  const auto pixel = [](double v, int size) { return std::clamp(static_cast<int>(v), 0, size - 1); };
  if (sheet.mask(pixel(cut.front().y, sheet.size.height), pixel(cut.front().x, sheet.size.width)) == 0) return false;
  const double apart = clearance_ + kHalfDiagonal;
  // Far from all that is no wood? The middle of the bounds tells; its pixel's is at most half a diagonal away.
  const Point middle = 0.5 * (box.low + box.high);
  double reach = 0;
  for (const Point p : cut) reach = std::max(reach, length(p - middle));
  if (sheet.depth(pixel(middle.y, sheet.size.height), pixel(middle.x, sheet.size.width)) > reach + apart + 1)
    return true;
  const Way way = along(sheet, cut, apart);
  if (way != Way::kUnsure) return way == Way::kFree && is_wood_inside(sheet, cut);
  bool free = true;
  each_bin(sheet, cut, apart, [&](int bin) {
    if (!free) return;
    for (const cv::Point p : sheet.rims[bin]) {
      const Point q{p.x + 0.5, p.y + 0.5};
      if (q.x < box.low.x - apart || q.x > box.high.x + apart || q.y < box.low.y - apart || q.y > box.high.y + apart)
        continue;
      if (distance(cut, q) < apart) {
        free = false;
        return;
      }
    }
  });
  return free;
}

std::vector<int> Wood::in_the_way(int panel, const Ring& cut) const {
  const Sheet& sheet = sheets_[panel];
  std::vector<int> found;
  each_bin(sheet, cut, clearance_, [&](int bin) {
    for (const int id : sheet.cuts[bin])
      if (!are_apart(cut, cuts_.at(id).ring, clearance_)) found.push_back(id);
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool Wood::has_room(int view, const Shape& shape, cv::Point group) const {
  const std::vector<Span>& groups = views_[view].groups;
  for (const Shape::Place& place : shape.places) {
    const cv::Point at = group + place.group;
    if (at.y >= static_cast<int>(groups.size()) || at.x < groups[at.y].begin || at.x >= groups[at.y].end ||
        *room_[view].at(at.y, at.x) < std::min(255.0, place.depth + clearance_ - kGroupReach))
      return false;
  }
  return true;
}

bool Wood::fits(int panel, const Ring& cut) const {
  if (!on_wood(panel, cut)) return false;
  const Sheet& sheet = sheets_[panel];
  bool free = true;
  each_bin(sheet, cut, clearance_, [&](int bin) {
    for (std::size_t i = 0; free && i < sheet.cuts[bin].size(); ++i)
      free = are_apart(cut, cuts_.at(sheet.cuts[bin][i]).ring, clearance_);
  });
  return free;
}

void Wood::take(int id, int panel, Ring cut) {
  assert(cuts_.find(id) == cuts_.end());
  Sheet& sheet = sheets_[panel];
  each_bin(sheet, cut, 0, [&](int bin) {
    std::vector<int>& ids = sheet.cuts[bin];
    ids.insert(std::upper_bound(ids.begin(), ids.end(), id), id);
  });
  for (int v = 0; v < static_cast<int>(views_.size()); ++v)
    if (views_[v].panel == panel) narrow_room(v, cut);
  cuts_.emplace(id, Cut{panel, std::move(cut)});
}

void Wood::put_back(int id) {
  const auto found = cuts_.find(id);
  assert(found != cuts_.end());
  const Cut cut = std::move(found->second);
  cuts_.erase(found);
  each_bin(sheets_[cut.panel], cut.ring, 0, [&](int bin) { std::erase(sheets_[cut.panel].cuts[bin], id); });
  for (int v = 0; v < static_cast<int>(views_.size()); ++v)
    if (views_[v].panel == cut.panel) widen_room(v, cut.ring);
}

// From there to the middle of its pixel it is up to half a diagonal, which is what pixels that are no wood reach
// beyond their middles; the panel's sides are half a pixel nearer to it than the middles of pixels outside.
std::uint8_t Wood::bare_room(const Sheet& sheet, const Turn& turn, int x, int y) const {
  const Point p = turn.to_picture(group_middle(x, y));
  if (p.x < 0 || p.y < 0 || p.x >= sheet.size.width || p.y >= sheet.size.height) return 0;
  return rounded_up(sheet.depth(static_cast<int>(p.y), static_cast<int>(p.x)) + 0.25);
}

template <class Visit>
void Wood::each_group_near(int view, const Ring& cut, const Visit& visit) {
  const View& at = views_[view];
  // The frame's turn is the same about any point: back from the panel by four corners of the bounds.
  const Bounds box = bounds_of(cut);
  const Point origin = at.turn.to_picture({0, 0});
  const Point right = at.turn.to_picture({1, 0}) - origin, down = at.turn.to_picture({0, 1}) - origin;
  Ring corners;
  for (const Point p : {box.low, box.high, Point{box.low.x, box.high.y}, Point{box.high.x, box.low.y}})
    corners.push_back({dot(p - origin, right), dot(p - origin, down)});
  const Bounds frame = bounds_of(corners);
  const auto group = [](double v) { return static_cast<int>(std::floor(v / kGroup)); };
  const int top = std::max(0, group(frame.low.y - reach_));
  const int bottom = std::min(static_cast<int>(at.groups.size()) - 1, group(frame.high.y + reach_));
  for (int y = top; y <= bottom; ++y)
    for (int x = std::max(at.groups[y].begin, group(frame.low.x - reach_));
         x < std::min(at.groups[y].end, group(frame.high.x + reach_) + 1); ++x)
      visit(x, y);
}

void Wood::narrow_room(int view, const Ring& cut) {
  each_group_near(view, cut, [&](int x, int y) {
    std::uint8_t& room = *room_[view].at(y, x);
    room = std::min(room, rounded_up(distance(cut, views_[view].turn.to_picture(group_middle(x, y)))));
  });
}

void Wood::widen_room(int view, const Ring& cut) {
  const Sheet& sheet = sheets_[views_[view].panel];
  std::vector<int> near;
  each_bin(sheet, cut, 2 * reach_,
           [&](int bin) { near.insert(near.end(), sheet.cuts[bin].begin(), sheet.cuts[bin].end()); });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  each_group_near(view, cut,
                  [&](int x, int y) { *room_[view].at(y, x) = bare_room(sheet, views_[view].turn, x, y); });
  for (const int id : near) narrow_room(view, cuts_.at(id).ring);
}

}  // namespace tessera::parquetry

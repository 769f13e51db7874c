#include "tessera/job/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/portable_math.h"
#include "tessera/base/text.h"
#include "tessera/geometry/scan.h"
#include "tessera/job/markup.h"

namespace tessera {
namespace {

constexpr double kFarthest = 1e7;
constexpr std::size_t kMostShapes = 200000, kMostPoints = 20'000'000;

tl::unexpected<Status> unusable(std::string message) {
  return fail(StatusCode::kInvalidInput, "", std::move(message));
}

// ---- Numbers

// SVG's numbers need nothing between them: "1.5.5-2" are three.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : rest_(text) {}

  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" ,\t\r\n"), rest_.size())); }
  bool at_end() {
    skip();
    return rest_.empty();
  }
  char peek() {
    skip();
    return rest_.empty() ? '\0' : rest_.front();
  }
  char take() {
    const char c = peek();
    if (!rest_.empty()) rest_.remove_prefix(1);
    return c;
  }
  bool take_number(double& number) {
    skip();
    std::size_t end = 0;
    const auto digits = [&] {
      const std::size_t begin = end;
      while (end < rest_.size() && rest_[end] >= '0' && rest_[end] <= '9') ++end;
      return end - begin;
    };
    if (!rest_.empty() && rest_.front() == '+') rest_.remove_prefix(1);
    if (!rest_.empty() && rest_.front() == '-') ++end;
    std::size_t count = digits();
    if (end < rest_.size() && rest_[end] == '.') ++end, count += digits();
    if (count == 0) return false;
    if (const std::size_t mantissa = end; end < rest_.size() && (rest_[end] | 0x20) == 'e') {
      ++end;
      if (end < rest_.size() && (rest_[end] == '-' || rest_[end] == '+')) ++end;
      if (digits() == 0) end = mantissa;
    }
    std::string text(rest_.substr(0, end));
    if (text.back() == '.') text += '0';
    rest_.remove_prefix(end);
    return parse_number(text, number) && std::abs(number) < kFarthest;
  }
  // A flag of an arc: one digit, whatever follows.
  bool take_flag(double& flag) {
    const char c = take();
    flag = c == '1' ? 1 : 0;
    return c == '0' || c == '1';
  }

 private:
  std::string_view rest_;
};

// ---- Transforms

struct Transform {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Point operator()(Point p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  friend Transform operator*(const Transform& s, const Transform& t) {  // first t
    return {s.a * t.a + s.c * t.b, s.b * t.a + s.d * t.b,       s.a * t.c + s.c * t.d,
            s.b * t.c + s.d * t.d, s.a * t.e + s.c * t.f + s.e, s.b * t.e + s.d * t.f + s.f};
  }
  // Within what points times it leave finite.
  bool is_usable() const {
    constexpr double kMost = 1e100;
    const auto small = [](double v) { return std::abs(v) < kMost; };
    return small(a) && small(b) && small(c) && small(d) && small(e) && small(f);
  }
};

std::optional<Transform> transform_of(std::string_view text) {
  Transform all;
  while (text.find_first_not_of(" ,\t\r\n") != std::string_view::npos) {
    text.remove_prefix(text.find_first_not_of(" ,\t\r\n"));
    const std::size_t open = text.find('('), close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return std::nullopt;
    std::string_view name = text.substr(0, open);
    while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
    std::vector<double> n;
    Numbers numbers(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
    while (!numbers.at_end())
      if (!numbers.take_number(n.emplace_back())) return std::nullopt;
    const auto or_else = [&](std::size_t i, double otherwise) { return i < n.size() ? n[i] : otherwise; };
    if (n.empty()) return std::nullopt;
    if (name == "matrix" && n.size() == 6) {
      all = all * Transform{n[0], n[1], n[2], n[3], n[4], n[5]};
    } else if (name == "translate" && n.size() <= 2) {
      all = all * Transform{1, 0, 0, 1, n[0], or_else(1, 0)};
    } else if (name == "scale" && n.size() <= 2) {
      all = all * Transform{n[0], 0, 0, or_else(1, n[0]), 0, 0};
    } else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
      if (std::abs(n[0]) > 1e5) return std::nullopt;
      const SinCos turn = sin_cos(n[0] * kPi / 180);
      const double x = or_else(1, 0), y = or_else(2, 0);
      all = all * Transform{1, 0, 0, 1, x, y} * Transform{turn.cos, turn.sin, -turn.sin, turn.cos, 0, 0} *
            Transform{1, 0, 0, 1, -x, -y};
    } else {
      return std::nullopt;
    }
  }
  return all;
}

// ---- Paths

Point ellipse_point(Point centre, double rx, double ry, SinCos tilt, double angle) {
  const SinCos at = sin_cos(angle);
  const double x = rx * at.cos, y = ry * at.sin;
  return centre + Point{tilt.cos * x - tilt.sin * y, tilt.sin * x + tilt.cos * y};
}

class PathReader {
 public:
  explicit PathReader(std::string_view text) : numbers_(text) {}

  // Closed rings; nothing where it cannot be read, `open` where a subpath does not end where it begins.
  std::optional<std::vector<Ring>> read(bool& open) {
    char command = 0;
    while (!numbers_.at_end()) {
      const char c = numbers_.peek();
      if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) {
        command = numbers_.take();
      } else if (command == 'm') {
        command = 'l';
      } else if (command == 'M') {
        command = 'L';
      } else if (command == 'z' || command == 'Z') {
        return std::nullopt;
      }
      if (!step(command)) return std::nullopt;
    }
    end_ring();
    open = open_;
    return std::move(rings_);
  }

 private:
  bool step(char command) {
    relative_ = command >= 'a' && command <= 'z';
    const char kind = static_cast<char>(command | 0x20);
    if (kind != 'm' && kind != 'z' && !begun_) {
      if (rings_.empty()) return false;
      begin(at_);  // a subpath may go on where the one before was closed
    }
    Point p, q, r;
    switch (kind) {
      case 'm':
        if (!take(p)) return false;
        end_ring();
        begin(p);
        break;
      case 'z':
        if (begun_) at_ = ring_.front();
        end_ring(true);
        break;
      case 'l':
        if (!take(p)) return false;
        line_to(p);
        break;
      case 'h':
      case 'v': {
        double n = 0;
        if (!numbers_.take_number(n)) return false;
        double Point::*way = kind == 'h' ? &Point::x : &Point::y;
        p = at_;
        p.*way = relative_ ? at_.*way + n : n;
        line_to(p);
        break;
      }
      case 'c':
        if (!take(p) || !take(q) || !take(r)) return false;
        curve_to(p, q, r);
        break;
      case 's':
        if (!take(q) || !take(r)) return false;
        curve_to(last_ == 'c' ? 2 * at_ - handle_ : at_, q, r);
        break;
      case 'q':
        if (!take(q) || !take(r)) return false;
        quadratic_to(q, r);
        break;
      case 't':
        if (!take(r)) return false;
        quadratic_to(last_ == 'q' ? 2 * at_ - handle_ : at_, r);
        break;
      case 'a':
        if (!arc()) return false;
        break;
      default: return false;
    }
    last_ = kind == 's' ? 'c' : kind == 't' ? 'q' : kind;
    return points_ < kMostPoints;
  }

  bool take(Point& p) {
    if (!numbers_.take_number(p.x) || !numbers_.take_number(p.y)) return false;
    if (relative_) p += at_;
    return true;
  }
  void begin(Point p) {
    ring_ = {p};
    at_ = p;
    begun_ = true;
  }
  void line_to(Point p) {
    ring_.push_back(p);
    ++points_;
    at_ = p;
  }
  void end_ring(bool closed = false) {
    if (begun_ && ring_.size() > 1) {
      double reach = 0;
      for (const Point p : ring_) reach = std::max(reach, length(p - ring_.front()));
      const bool meets = length(ring_.back() - ring_.front()) <= 1e-3 * reach;
      open_ = open_ || !(closed || meets);
      if (ring_.size() > 2) rings_.push_back(std::move(ring_));
    }
    ring_.clear();
    begun_ = false;
  }
  void curve_to(Point p, Point q, Point r) {
    constexpr int kParts = 48;
    const Point from = at_;
    for (int i = 1; i <= kParts; ++i) {
      const double t = static_cast<double>(i) / kParts, s = 1 - t;
      line_to(i < kParts ? s * s * s * from + 3 * s * s * t * p + 3 * s * t * t * q + t * t * t * r : r);
    }
    handle_ = q;
  }
  void quadratic_to(Point q, Point r) {
    const Point from = at_;
    curve_to(from + 2.0 / 3 * (q - from), r + 2.0 / 3 * (q - r), r);
    handle_ = q;
  }
  // SVG 1.1, F.6.5: from end points to centre.
  bool arc() {
    double rx = 0, ry = 0, tilt_deg = 0, large = 0, sweep = 0;
    Point to;
    if (!numbers_.take_number(rx) || !numbers_.take_number(ry) || !numbers_.take_number(tilt_deg) ||
        !numbers_.take_flag(large) || !numbers_.take_flag(sweep) || !take(to) || std::abs(tilt_deg) > 1e5)
      return false;
    rx = std::abs(rx), ry = std::abs(ry);
    if (rx == 0 || ry == 0 || to == at_) {
      line_to(to);
      return true;
    }
    const SinCos tilt = sin_cos(tilt_deg * kPi / 180);
    const Point half = 0.5 * (at_ - to);
    const Point own{tilt.cos * half.x + tilt.sin * half.y, tilt.cos * half.y - tilt.sin * half.x};
    const double size = own.x * own.x / (rx * rx) + own.y * own.y / (ry * ry);
    constexpr double kFlat = 1e-20;  // of a circle as large as that a chord is the arc
    if (size < kFlat) {
      line_to(to);
      return true;
    }
    if (size > 1) rx *= std::sqrt(size), ry *= std::sqrt(size);
    const double flat = std::max(0.0, 1 / std::min(size, 1.0) - 1);
    const double factor = (large == sweep ? -1 : 1) * std::sqrt(flat);
    const Point middle{factor * rx * own.y / ry, -factor * ry * own.x / rx};
    const Point centre = 0.5 * (at_ + to) +
                         Point{tilt.cos * middle.x - tilt.sin * middle.y, tilt.sin * middle.x + tilt.cos * middle.y};
    const double begin = atan2_portable((own.y - middle.y) / ry, (own.x - middle.x) / rx);
    double way = atan2_portable((-own.y - middle.y) / ry, (-own.x - middle.x) / rx) - begin;
    if (sweep > 0 && way < 0) way += 2 * kPi;
    if (sweep == 0 && way > 0) way -= 2 * kPi;
    constexpr int kParts = 64;
    for (int i = 1; i < kParts; ++i) line_to(ellipse_point(centre, rx, ry, tilt, begin + way * i / kParts));
    line_to(to);
    return true;
  }

  Numbers numbers_;
  std::vector<Ring> rings_;
  Ring ring_;
  Point at_, handle_;
  char last_ = 0;
  bool relative_ = false, begun_ = false, open_ = false;
  std::size_t points_ = 0;
};

// ---- Elements

double length_of(std::string_view tag, std::string_view name, double otherwise = 0) {
  const auto text = attribute_of(tag, name);
  double number = otherwise;
  if (text && !Numbers(*text).take_number(number)) number = otherwise;
  return number;
}

Ring ellipse(Point centre, double rx, double ry) {
  constexpr int kParts = 128;
  Ring ring;
  for (int i = 0; i < kParts; ++i) ring.push_back(ellipse_point(centre, rx, ry, {0, 1}, 2 * kPi * i / kParts));
  return ring;
}

// Rings of an element that is a shape; none of others.
Result<std::vector<Ring>> rings_of(const MarkupPiece& tag, std::size_t number) {
  const std::string_view name = tag.local_name(), text = tag.text;
  const auto wrong = [&](const char* what) {
    return unusable(fmt::format("shape {}, a {}, {}", number, name, what));
  };
  if (name == "rect") {
    const double x = length_of(text, "x"), y = length_of(text, "y"), w = length_of(text, "width"),
                 h = length_of(text, "height");
    if (!(w > 0 && h > 0)) return wrong("has no width and height");
    return std::vector<Ring>{{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}};
  }
  if (name == "circle" || name == "ellipse") {
    const double r = length_of(text, "r"), rx = length_of(text, "rx", r), ry = length_of(text, "ry", r);
    if (!(rx > 0 && ry > 0)) return wrong("has no radius");
    return std::vector<Ring>{ellipse({length_of(text, "cx"), length_of(text, "cy")}, rx, ry)};
  }
  std::string path;
  if (name == "path") {
    path = attribute_of(text, "d").value_or("");
  } else if (name == "polygon") {
    path = fmt::format("M{}Z", attribute_of(text, "points").value_or(""));
  } else {
    return std::vector<Ring>{};
  }
  bool open = false;
  auto rings = PathReader(path).read(open);
  if (!rings || rings->empty()) return wrong("cannot be read, expected the outline of an area");
  if (open) return wrong("is open, expected closed outlines");
  return *std::move(rings);
}

struct Canvas {
  Transform to_pixels;
  Raster raster;
};

// The root's viewBox, else its width and height.
Result<Canvas> canvas_of(std::string_view tag, std::uint64_t max_pixels) {
  std::array<double, 4> box{0, 0, length_of(tag, "width"), length_of(tag, "height")};
  if (const auto view = attribute_of(tag, "viewBox")) {
    Numbers numbers(*view);
    for (double& number : box)
      if (!numbers.take_number(number)) return unusable("has a viewBox that is not four numbers");
  }
  const auto [left, top, width, height] = box;
  constexpr double kLeast = 1e-3, kLongest = 1000;
  if (!(width > kLeast && height > kLeast && width < kLongest * height && height < kLongest * width))
    return unusable("has no size, expected a viewBox, or a width and height");
  const double scale = kShapesSide / std::max(width, height);
  const auto pixels = [&](double side) { return std::max(1, static_cast<int>(std::lround(side * scale))); };
  Canvas canvas{{}, {pixels(width), pixels(height), 3, 8, {}}};
  const Raster& raster = canvas.raster;
  if (static_cast<std::uint64_t>(raster.width) * static_cast<std::uint64_t>(raster.height) > max_pixels)
    return unusable(fmt::format("is painted in {} x {} px, expected at most {:.6g} Mpx (--max-pixels)", raster.width,
                                raster.height, static_cast<double>(max_pixels) / 1e6));
  const double x = raster.width / width, y = raster.height / height;
  canvas.to_pixels = {x, 0, 0, y, -left * x, -top * y};
  canvas.raster.bytes.assign(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height) * 3, 0);
  return canvas;
}

void paint(std::vector<Ring> rings, const Transform& transform, std::size_t number, Raster& raster) {
  std::vector<const Ring*> all;
  for (Ring& ring : rings) {
    for (Point& p : ring) p = transform(p);
    all.push_back(&ring);
  }
  each_run(std::span<const Ring* const>(all), raster.width, raster.height, [&](int y, int begin, int end) {
    auto* pixel = raster.bytes.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) +
                                             static_cast<std::size_t>(begin));
    for (int x = begin; x < end; ++x)
      for (const int shift : {16, 8, 0}) *pixel++ = static_cast<std::uint8_t>(number >> shift);
  });
}

bool is_left_out(const MarkupPiece& tag) {
  constexpr std::array<std::string_view, 9> kUnseen = {"defs",   "symbol",   "clipPath", "mask", "pattern",
                                                       "marker", "metadata", "style",    "title"};
  return std::find(kUnseen.begin(), kUnseen.end(), tag.local_name()) != kUnseen.end() ||
         attribute_of(tag.text, "display") == "none";
}

}  // namespace

bool looks_like_svg(std::string_view bytes) {
  constexpr std::size_t kHead = 4096;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return first != std::string_view::npos && bytes[first] == '<' &&
         bytes.substr(0, kHead).find("<svg") != std::string_view::npos;
}

Result<Raster> read_shapes(std::string_view svg, std::uint64_t max_pixels) {
  struct Level {
    Transform transform;
    bool left_out = false;
  };
  std::vector<Level> levels;
  std::optional<Canvas> canvas;
  std::size_t shapes = 0;
  Markup markup(svg);
  while (const auto tag = markup.next()) {
    if (tag->kind != MarkupPiece::Kind::kTag) continue;
    if (tag->is_closing()) {
      if (levels.empty()) return unusable("is not well-formed XML");
      levels.pop_back();
      continue;
    }
    if (!canvas) {
      if (tag->local_name() != "svg") return unusable("is no SVG");
      auto made = canvas_of(tag->text, max_pixels);
      if (!made) return tl::unexpected<Status>(std::move(made.error()));
      canvas = *std::move(made);
    }
    Level level = levels.empty() ? Level{canvas->to_pixels, false} : levels.back();
    level.left_out = level.left_out || is_left_out(*tag);
    if (!level.left_out) {
      const auto own = transform_of(attribute_of(tag->text, "transform").value_or(""));
      if (!own) return unusable(fmt::format("has a transform of {} that cannot be read", tag->local_name()));
      level.transform = level.transform * *own;
      if (!level.transform.is_usable())
        return unusable(fmt::format("has a transform of {} that leads too far", tag->local_name()));
      auto rings = rings_of(*tag, shapes + 1);
      if (!rings) return tl::unexpected<Status>(std::move(rings.error()));
      if (!rings->empty()) {
        if (++shapes > kMostShapes) return unusable(fmt::format("has more than {} shapes", kMostShapes));
        paint(*std::move(rings), level.transform, shapes, canvas->raster);
      }
    }
    if (!tag->is_empty_element()) levels.push_back(level);
  }
  if (!markup.is_at_end() || !levels.empty()) return unusable("is not well-formed XML");
  if (shapes == 0) return unusable("has no closed shape");
  return std::move(canvas->raster);
}

}  // namespace tessera

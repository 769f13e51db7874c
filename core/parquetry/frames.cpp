#include "tessera/parquetry/frames.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/portable_math.h"

namespace tessera::parquetry {
namespace {

constexpr double kOne = 4294967296.0;  // 2^32

std::int64_t fixed(double v) { return std::llround(v * kOne); }

// Exact where the turn is a multiple of a right angle.
double clean(double v) {
  const double whole = std::round(v);
  return std::fabs(v - whole) < 1e-12 ? whole : v;
}

bool within(std::int64_t v, int size) { return v >= 0 && v < (std::int64_t{size} << 32); }

// A pixel between four; x and y are 256ths of the way from the first to the second.
template <int kChannels>
void blend(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c, const std::uint8_t* d, int x, int y,
           std::uint8_t* to) {
  for (int k = 0; k < kChannels; ++k) {
    const int upper = a[k] * (256 - x) + b[k] * x, lower = c[k] * (256 - x) + d[k] * x;
    to[k] = static_cast<std::uint8_t>((upper * (256 - y) + lower * y + (1 << 15)) >> 16);
  }
}

}  // namespace

Turn::Turn(cv::Size picture, double degrees) : picture_(picture), degrees_(degrees) {
  const SinCos turn = sin_cos(degrees * kPi / 180);
  cos_ = clean(turn.cos);
  sin_ = clean(turn.sin);
  const double width = std::fabs(picture.width * cos_) + std::fabs(picture.height * sin_);
  const double height = std::fabs(picture.width * sin_) + std::fabs(picture.height * cos_);
  size_ = {static_cast<int>(std::ceil(width - 1e-6)), static_cast<int>(std::ceil(height - 1e-6))};
  cosine_ = fixed(cos_);
  sine_ = fixed(sin_);
  const Point first = to_picture({0.5, 0.5});
  x0_ = fixed(first.x);
  y0_ = fixed(first.y);
}

Point Turn::to_picture(Point frame) const {
  const Point off = frame - Point{0.5 * size_.width, 0.5 * size_.height};
  return Point{0.5 * picture_.width, 0.5 * picture_.height} +
         Point{cos_ * off.x + sin_ * off.y, cos_ * off.y - sin_ * off.x};
}

std::vector<Span> Turn::spans() const {
  std::vector<Span> spans(size_.height);
  for (int y = 0; y < size_.height; ++y) {
    const auto inside = [&](int x) {
      return within(x_at(x, y), picture_.width) && within(y_at(x, y), picture_.height);
    };
    int begin = 0, end = size_.width;
    while (begin < end && !inside(begin)) ++begin;
    while (end > begin && !inside(end - 1)) --end;
    spans[y] = {begin, end};
  }
  return spans;
}

Rows Turn::turned(const cv::Mat& picture, int around) const {
  const int channels = picture.channels();
  const std::vector<Span> spans = this->spans();
  Rows rows(spans, channels, around);
  const auto draw = [&]<int kChannels>(int y) {
    std::uint8_t* to = rows.at(y, spans[y].begin);
    for (int x = spans[y].begin; x < spans[y].end; ++x, to += kChannels) {
      // From the middles of the pixels; 2^24 parts of a pixel are a 256th.
      const std::int64_t px = (x_at(x, y) - (std::int64_t{1} << 31)) >> 24,
                         py = (y_at(x, y) - (std::int64_t{1} << 31)) >> 24;
      const int left = static_cast<int>(px >> 8), top = static_cast<int>(py >> 8);
      const std::ptrdiff_t x1 = std::max(0, left), x2 = std::min(picture.cols - 1, left + 1);
      const std::uint8_t* upper = picture.ptr(std::max(0, top));
      const std::uint8_t* lower = picture.ptr(std::min(picture.rows - 1, top + 1));
      blend<kChannels>(upper + x1 * kChannels, upper + x2 * kChannels, lower + x1 * kChannels, lower + x2 * kChannels,
                       static_cast<int>(px & 255), static_cast<int>(py & 255), to);
    }
  };
  for (int y = 0; y < size_.height; ++y) {
    switch (channels) {
      case 1: draw.operator()<1>(y); break;
      case 2: draw.operator()<2>(y); break;
      case 3: draw.operator()<3>(y); break;
      default: draw.operator()<4>(y);
    }
  }
  return rows;
}

double degrees_of(int rotation, const Params& params) { return 360.0 * rotation / params.rotations; }

std::vector<int> allowed_rotations(const Params& params) {
  std::vector<int> allowed;
  for (int j = 0; j < params.rotations; ++j) {
    // In parts of a full turn of 2 * rotations, so that the half turn is exact.
    const int off =
        std::min({2 * j % (2 * params.rotations), std::abs(2 * j - params.rotations), 2 * params.rotations - 2 * j});
    const double degrees = 180.0 * off / params.rotations;
    if (params.grain == Grain::kAny || off == 0 ||
        (params.grain == Grain::kDegrees && degrees <= params.grain_degrees))
      allowed.push_back(j);
  }
  return allowed;
}

Placement place(const Turn& turn, int rotation, cv::Size size, cv::Point at, Point middle) {
  Placement placement;
  placement.rotation = rotation;
  placement.at = at;
  placement.turn_deg = turn.degrees();
  placement.from = middle;
  placement.to = turn.to_picture({at.x + 0.5 * size.width, at.y + 0.5 * size.height});
  return placement;
}

}  // namespace tessera::parquetry

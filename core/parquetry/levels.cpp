#include "tessera/parquetry/levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::parquetry {
namespace {

constexpr double kCutOff =
    0.0001;                    // share of the pixels, the lightest and the darkest, that `scale` need not tell apart
constexpr double kFinest = 8;  // steps to a level
constexpr double kMargin = 1.0 / 64;  // of a byte: more than floats lose

double cut(double v) { return std::clamp(v, 0.0, 255.0); }

std::uint8_t rounded(float v) { return static_cast<std::uint8_t>(std::clamp(v + 0.5f, 0.0f, 255.0f)); }

struct Range {
  int low = 0, high = 0;
};

Range usual_range(const std::array<std::int64_t, 256>& histogram) {
  std::int64_t all = 0;
  for (const std::int64_t count : histogram) all += count;
  const auto few = static_cast<std::int64_t>(kCutOff * static_cast<double>(all));
  Range range{0, 255};
  for (std::int64_t below = histogram[0]; range.low < 255 && below <= few;) below += histogram[++range.low];
  for (std::int64_t above = histogram[255]; range.high > range.low && above <= few;) above += histogram[--range.high];
  return range;
}

// Sums of the columns of a band of rows, and of their squares, as the band moves down.
class ColumnSums {
 public:
  ColumnSums(const Rows& features, const std::vector<Span>& pixels, int width, int channels, int channel)
      : features_(features),
        pixels_(pixels),
        channels_(channels),
        channel_(channel),
        sum_(width, 0),
        square_(width, 0) {}

  void add(int y) {
    each(y, [](std::uint32_t& sum, std::uint32_t v) { sum += v; });
  }
  void remove(int y) {
    each(y, [](std::uint32_t& sum, std::uint32_t v) { sum -= v; });
  }

  // Means and deviations of windows `side` wide that begin at x in [begin, end).
  void measure(int side, int begin, int end, float* mean, float* deviation) {
    std::uint32_t sum = 0, square = 0;
    for (int x = begin; x < begin + side - 1; ++x) {
      sum += sum_[x];
      square += square_[x];
    }
    window_.resize(2 * static_cast<std::size_t>(end - begin));
    std::size_t next = 0;
    for (int x = begin; x < end; ++x) {
      sum += sum_[x + side - 1];
      square += square_[x + side - 1];
      window_[next++] = sum;
      window_[next++] = square;
      sum -= sum_[x];
      square -= square_[x];
    }
    // n Q - S^2 <= (n 255)^2, which is below 2^32 for blocks of 16 x 16 pixels.
    const auto pixels = static_cast<std::uint32_t>(side * side);
    const float share = 1.0f / static_cast<float>(pixels);
    for (std::size_t i = 0; i < window_.size() / 2; ++i) {
      const std::uint32_t s = window_[2 * i], q = window_[2 * i + 1];
      mean[i] = share * static_cast<float>(s);
      deviation[i] = share * std::sqrt(static_cast<float>(pixels * q - s * s));
    }
  }

 private:
  template <class Change>
  void each(int y, const Change& change) {
    if (pixels_[y].begin >= pixels_[y].end) return;
    const std::uint8_t* from = features_.at(y, pixels_[y].begin) + channel_;
    for (int x = pixels_[y].begin; x < pixels_[y].end; ++x, from += channels_) {
      const std::uint32_t v = *from;
      change(sum_[x], v);
      change(square_[x], v * v);
    }
  }

  const Rows& features_;
  const std::vector<Span>& pixels_;
  int channels_, channel_;
  std::vector<std::uint32_t> sum_, square_, window_;
};

// Least and greatest of what is seen in a row of groups.
struct Extremes {
  std::vector<float> low, high;

  void begin(int width) {
    low.assign(width, std::numeric_limits<float>::infinity());
    high.assign(width, -std::numeric_limits<float>::infinity());
  }
  void see(const std::vector<float>& values, int count) {
    for (int i = 0; i < count; ++i) {
      low[i] = std::min(low[i], values[i]);
      high[i] = std::max(high[i], values[i]);
    }
  }
};

}  // namespace

double ByteCode::mean(double v, int channel) const { return cut((v - offset[channel]) * scale); }
double ByteCode::deviation(double v) const { return cut(v * scale); }

std::uint8_t ByteCode::mean_byte(float v, int channel) const {
  return rounded((v - static_cast<float>(offset[channel])) * static_cast<float>(scale));
}
std::uint8_t ByteCode::deviation_byte(float v) const { return rounded(v * static_cast<float>(scale)); }

ByteCode byte_code(const std::vector<cv::Mat>& features, const std::vector<cv::Mat1b>& masks) {
  ByteCode code;
  code.channels = features.empty() ? 1 : features[0].channels();
  int widest = 1;
  for (int c = 0; c < code.channels; ++c) {
    std::array<std::int64_t, 256> histogram{};
    for (std::size_t i = 0; i < features.size(); ++i)
      for (int y = 0; y < features[i].rows; ++y)
        for (int x = 0; x < features[i].cols; ++x)
          if (masks[i](y, x) != 0) ++histogram[features[i].ptr(y)[x * code.channels + c]];
    const Range range = usual_range(histogram);
    code.offset[c] = range.low;
    widest = std::max(widest, range.high - range.low);
  }
  code.scale = std::min(kFinest, 255.0 / widest);
  return code;
}

Moments moments_of(const cv::Mat& features, int channel, cv::Rect block) {
  std::int64_t sum = 0, square = 0;
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) {
      const std::int64_t v = features.ptr(y, x)[channel];
      sum += v;
      square += v * v;
    }
  const std::int64_t n = block.area();
  return {static_cast<double>(sum) / static_cast<double>(n),
          std::sqrt(static_cast<double>(n * square - sum * sum)) / static_cast<double>(n)};
}

Rows fine_level(const Rows& features, const std::vector<Span>& pixels, const std::vector<Span>& groups,
                cv::Size frame, const ByteCode& code) {
  Rows level(groups, 2 * code.channels, frame.width / kGroup + 1, kGroup);
  std::vector<float> mean(frame.width), deviation(frame.width);
  for (int c = 0; c < code.channels; ++c) {
    ColumnSums columns(features, pixels, frame.width, code.channels, c);
    for (int g = 0; (g + 1) * kGroup <= frame.height; ++g) {
      const int begin = groups[g].begin * kGroup;
      const int end = std::min(groups[g].end * kGroup, frame.width - kGroup + 1);
      if (begin >= end) continue;
      for (int y = g * kGroup; y < (g + 1) * kGroup; ++y) columns.add(y);
      columns.measure(kGroup, begin, end, mean.data(), deviation.data());
      for (int y = g * kGroup; y < (g + 1) * kGroup; ++y) columns.remove(y);
      for (int x = begin; x < end; ++x) {
        std::uint8_t* to = level.at(g, x / kGroup, x % kGroup) + std::ptrdiff_t{2} * c;
        to[0] = code.mean_byte(mean[x - begin], c);
        to[1] = code.deviation_byte(deviation[x - begin]);
      }
    }
  }
  return level;
}

Rows coarse_level(const Rows& features, const std::vector<Span>& pixels, const std::vector<Span>& groups,
                  cv::Size frame, int side, const ByteCode& code) {
  Rows level(groups, 1, frame.width / kGroup + 1, 4 * code.channels);
  std::vector<float> mean(frame.width), deviation(frame.width);
  Extremes means, deviations;
  for (int c = 0; c < code.channels; ++c) {
    ColumnSums columns(features, pixels, frame.width, code.channels, c);
    for (int y = 0; y < std::min(side - 1, frame.height); ++y) columns.add(y);
    for (int g = 0; g < static_cast<int>(groups.size()); ++g) {
      const int begin = groups[g].begin * kGroup;
      const int end = std::min(groups[g].end * kGroup, frame.width - side + 1);
      const int count = std::max(0, end - begin);
      means.begin(count);
      deviations.begin(count);
      for (int y = g * kGroup; y < (g + 1) * kGroup && y + side <= frame.height; ++y) {
        columns.add(y + side - 1);
        if (count > 0) {
          columns.measure(side, begin, end, mean.data(), deviation.data());
          means.see(mean, count);
          deviations.see(deviation, count);
        }
        columns.remove(y);
      }
      const auto keep = [&](const Extremes& of, int plane, const auto& byte) {
        for (int x = groups[g].begin; x < groups[g].end; ++x) {
          float low = std::numeric_limits<float>::infinity(), high = -low;
          for (int i = x * kGroup - begin; i < std::min(count, (x + 1) * kGroup - begin); ++i) {
            low = std::min(low, of.low[i]);
            high = std::max(high, of.high[i]);
          }
          const bool known = low <= high;
          *level.at(g, x, plane) =
              known ? static_cast<std::uint8_t>(std::max(0.0, std::floor(byte(low) - kMargin))) : 0;
          *level.at(g, x, plane + 1) =
              known ? static_cast<std::uint8_t>(std::min(255.0, std::ceil(byte(high) + kMargin))) : 255;
        }
      };
      keep(means, 4 * c, [&](float v) { return code.mean(v, c); });
      keep(deviations, 4 * c + 2, [&](float v) { return code.deviation(v); });
    }
  }
  return level;
}

}  // namespace tessera::parquetry

#include "tessera/image/lab.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tessera {
namespace {

constexpr int kOne = 1 << 15;    // of linear light, and of the cube root
constexpr int kRoots = 1 << 12;  // entries of the table of cube roots
constexpr int kPerRoot = kOne / kRoots;

// x^(1/n), 0 < x <= 1, by Newton's method: the same everywhere, as the C library's pow is not.
double root(double x, int n) {
  double y = 1;
  for (int round = 0; round < 200; ++round) {
    double power = 1;
    for (int k = 1; k < n; ++k) power *= y;
    const double next = y + (x / power - y) / n;
    if (std::fabs(next - y) < 1e-15) break;
    y = next;
  }
  return y;
}

struct Tables {
  std::array<int, 256> linear{};            // of a channel's level
  std::array<int, kRoots + 1> cube_root{};  // CIE's f(t) with its straight beginning
};

const Tables& tables() {
  static const Tables all = [] {
    Tables t;
    for (int level = 0; level < 256; ++level) {
      const double v = level / 255.0, u = (v + 0.055) / 1.055;
      t.linear[level] = static_cast<int>(std::lround(kOne * (v <= 0.04045 ? v / 12.92 : u * u * root(u * u, 5))));
    }
    for (int k = 0; k <= kRoots; ++k) {
      const double v = static_cast<double>(k) / kRoots;
      t.cube_root[k] = static_cast<int>(std::lround(kOne * (v > 0.008856 ? root(v, 3) : 7.787 * v + 16.0 / 116)));
    }
    return t;
  }();
  return all;
}

// Rows: X / Xn, Y, Z / Zn of linear R, G, B; each adds up to kOne.
constexpr int kXyz[3][3] = {{14220, 12328, 6220}, {6969, 23434, 2365}, {582, 3587, 28599}};

std::uint8_t level(int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); }

}  // namespace

cv::Mat3b lab_of(const cv::Mat3b& rgb) {
  const Tables& t = tables();
  cv::Mat3b lab(rgb.size());
  cv::parallel_for_({0, rgb.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < rgb.cols; ++x) {
        const cv::Vec3b& pixel = rgb(y, x);
        const int r = t.linear[pixel[0]], g = t.linear[pixel[1]], b = t.linear[pixel[2]];
        int f[3];
        for (int k = 0; k < 3; ++k) {
          const int sum = (kXyz[k][0] * r + kXyz[k][1] * g + kXyz[k][2] * b) / kOne;
          f[k] = t.cube_root[std::min(kRoots, (sum + kPerRoot / 2) / kPerRoot)];
        }
        // L = 116 f(Y) - 16, a = 500 (f(X) - f(Y)), b = 200 (f(Y) - f(Z)), rounded.
        lab(y, x) = {level((2958 * f[1] / 10 - 408 * (kOne / 10) + kOne / 2) / kOne),
                     level((500 * (f[0] - f[1]) + 128 * kOne + kOne / 2) / kOne),
                     level((200 * (f[1] - f[2]) + 128 * kOne + kOne / 2) / kOne)};
      }
  });
  return lab;
}

}  // namespace tessera

#include "tessera/base/portable_math.h"

#include <cmath>
#include <initializer_list>

namespace tessera {
namespace {

// pi/2 in two parts, so that k * kHalfPiHigh is exact for the k that occur.
constexpr double kHalfPiHigh = 1.57079632673412561417e+00;
constexpr double kHalfPiLow = 6.07710050650619224932e-11;

// Nearest whole number, ties to even, for |v| < 2^51: at this size a double has no digits after the point. (The
// library's rint is a call where the instruction is not.)
double round_even(double v) {
  constexpr double kWhole = 6755399441055744.0;  // 1.5 * 2^52
  return (v + kWhole) - kWhole;
}

// Taylor series on |x| <= pi/4, Horner form.
double sin_series(double x) {
  const double z = x * x;
  double s = -1.0 / 1307674368000.0;
  for (double c : {1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0})
    s = s * z + c;
  return x + x * z * s;
}

double cos_series(double x) {
  const double z = x * x;
  double s = 1.0 / 20922789888000.0;
  for (double c : {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0,
                   -0.5})
    s = s * z + c;
  return 1.0 + z * s;
}

// Arctangent of 0 <= t <= 1: halved twice by atan t = 2 atan(t / (1 + sqrt(1 + t^2))), then its series.
double atan_unit(double t) {
  t = t / (1.0 + std::sqrt(1.0 + t * t));
  t = t / (1.0 + std::sqrt(1.0 + t * t));
  const double z = t * t;
  double s = 0;
  for (double c : {1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3, 1.0}) s = c - z * s;
  return 4.0 * t * s;
}

}  // namespace

SinCos sin_cos(double angle) {
  const double k = round_even(angle * (2.0 / kPi));
  const double x = (angle - k * kHalfPiHigh) - k * kHalfPiLow;
  const double s = sin_series(x), c = cos_series(x);
  const int quarter = static_cast<int>(k) & 3;
  const double sine = quarter & 1 ? c : s, cosine = quarter & 1 ? s : c;
  return {quarter & 2 ? -sine : sine, (quarter + 1) & 2 ? -cosine : cosine};
}

double atan2_portable(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  if (ax == 0 && ay == 0) return 0;
  double a = ay <= ax ? atan_unit(ay / ax) : kPi / 2 - atan_unit(ax / ay);
  if (x < 0) a = kPi - a;
  return y < 0 ? -a : a;
}

double snap_position(double v) { return round_even(v * 1024.0) / 1024.0; }

double snap_angle(double v) {
  constexpr double kStep = 2.0 * kPi / 65536.0;
  return round_even(v / kStep) * kStep;
}

}  // namespace tessera

// The few transcendental functions that decide where a stone lies. The C library's differ in the last bit between
// platforms, which grows over Lloyd iterations; these use only additions, multiplications and divisions, which do not.
#pragma once

namespace tessera {

inline constexpr double kPi = 3.14159265358979323846;

struct SinCos {
  double sin, cos;
};

// |error| < 1e-13 for |angle| <= 1e4 radians.
SinCos sin_cos(double angle);

// Angle of (x, y) in (-pi, pi], 0 for (0, 0); |error| < 1e-12.
double atan2_portable(double y, double x);

// Rounds to the nearest multiple of 2^-10 (positions, px) and of 2^-16 turn (angles, radians).
double snap_position(double v);
double snap_angle(double v);

}  // namespace tessera

// Where a scanned panel lies on the machine, by fiducials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tessera/base/status.h"
#include "tessera/geometry/point.h"

namespace tessera::parquetry {

// p -> (xx x + xy y + at.x, yx x + yy y + at.y)
struct Affine {
  double xx = 1, xy = 0, yx = 0, yy = 1;
  Point at{};

  Point operator()(Point p) const { return {xx * p.x + xy * p.y + at.x, yx * p.x + yy * p.y + at.y}; }
};

enum class Registration { kSimilarity, kAffine };

struct Fitted {
  Affine map;
  std::vector<double> residuals;  // a pair each: how far the mapped place is from where it should be
  double rms = 0;                 // of the residuals
};

// The map that takes `from` to `to` with the least sum of squared residuals: turned, shifted and resized evenly, or
// any affine one. Two pairs at least, as many of one as of the other.
Fitted fit(const std::vector<Point>& from, const std::vector<Point>& to, Registration kind);

// The same of places whose order is not known: each of `to` has the nearest of `from` under the map, which turns them
// the least where several fit alike. Residuals are those of `to`. Nothing where no places are as far apart as these.
std::optional<Fitted> fit_unordered(const std::vector<Point>& from, const std::vector<Point>& to, Registration kind);

inline constexpr double kWorstFitMm = 0.3;  // rms

// kInvalidInput with every residual where a fit is worse than that.
Result<void> check_fit(const Fitted& fitted, const std::string& panel);

}  // namespace tessera::parquetry

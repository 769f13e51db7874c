#include "tessera/points/density.h"

#include <algorithm>
#include <cmath>

#include "tessera/base/distributions.h"

namespace tessera {
namespace {

constexpr double kStepsAScale = 6;
constexpr double kMostCells = 4e6;
constexpr double kKernelReach = 3;  // scales: exp(-9) is nothing

// Weights of exp(-r^2 / scale^2), whose squares add up to 1.
std::vector<double> kernel_of(double steps) {
  const int reach = static_cast<int>(std::ceil(kKernelReach * steps));
  std::vector<double> weights;
  double squares = 0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::exp(-(k / steps) * (k / steps)));
    squares += weights.back() * weights.back();
  }
  for (double& w : weights) w /= std::sqrt(squares);
  return weights;
}

// Lines of `count` values under the kernel; without a period each line brings the kernel's reach at both ends.
void convolve(const std::vector<double>& from, std::vector<double>& to, int lines, int count, bool periodic,
              const std::vector<double>& kernel) {
  const int taps = static_cast<int>(kernel.size()), before = taps / 2;
  const int given = periodic ? count : count + taps - 1;
  to.assign(static_cast<std::size_t>(lines) * count, 0);
  for (int line = 0; line < lines; ++line)
    for (int i = 0; i < count; ++i) {
      double sum = 0;
      for (int k = 0; k < taps; ++k) {
        const int at = periodic ? ((i + k - before) % count + count) % count : i + k;
        sum += kernel[k] * from[static_cast<std::size_t>(line) * given + at];
      }
      to[static_cast<std::size_t>(line) * count + i] = sum;
    }
}

std::vector<double> transposed(const std::vector<double>& values, int rows, int columns) {
  std::vector<double> result(values.size());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      result[static_cast<std::size_t>(c) * rows + r] = values[static_cast<std::size_t>(r) * columns + c];
  return result;
}

}  // namespace

double Density::at(Point p) const {
  if (window.periodic) p = window.wrapped(p);
  const auto cell = [](double v, double low, double size, int count) {
    return std::clamp(static_cast<int>(std::floor((v - low) / size * count)), 0, count - 1);
  };
  const int column = cell(p.x, window.low.x, window.size().x, columns);
  const int row = cell(p.y, window.low.y, window.size().y, rows);
  return values[static_cast<std::size_t>(row) * columns + column];
}

double Density::largest() const { return *std::max_element(values.begin(), values.end()); }

Density gaussian_field(const Window& window, double scale, Rng& rng) {
  const Point size = window.size();
  const double step = std::max(scale / kStepsAScale, std::sqrt(window.area() / kMostCells));
  Density field{window,
                std::max(1, static_cast<int>(std::ceil(size.x / step))),
                std::max(1, static_cast<int>(std::ceil(size.y / step))),
                {}};
  const auto kernel_x = kernel_of(scale * field.columns / size.x), kernel_y = kernel_of(scale * field.rows / size.y);
  const int more_x = window.periodic ? 0 : static_cast<int>(kernel_x.size()) - 1;
  const int more_y = window.periodic ? 0 : static_cast<int>(kernel_y.size()) - 1;
  const int noise_rows = field.rows + more_y;
  std::vector<double> noise(static_cast<std::size_t>(field.columns + more_x) * noise_rows);
  for (double& v : noise) v = draw_normal(rng);
  std::vector<double> across, smooth;
  convolve(noise, across, noise_rows, field.columns, window.periodic, kernel_x);
  convolve(transposed(across, noise_rows, field.columns), smooth, field.columns, field.rows, window.periodic,
           kernel_y);
  field.values = transposed(smooth, field.columns, field.rows);
  return field;
}

Density log_gaussian_density(const Window& window, double scale, double deviation, Rng& rng) {
  Density density = gaussian_field(window, scale, rng);
  for (double& v : density.values) v = std::exp(deviation * v - deviation * deviation / 2);
  return density;
}

}  // namespace tessera

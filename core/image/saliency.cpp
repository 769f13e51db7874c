#include "tessera/image/saliency.h"

#include <algorithm>
#include <array>

#include "tessera/image/lab.h"

namespace tessera {
namespace {

constexpr int kBinomial[] = {1, 4, 6, 4, 1};  // the paper's kernel against noise, of sum 16
constexpr int kReach = 2;

// A row or column summed with the kernel, ends repeated.
template <class At>
cv::Vec3i weighted(int i, int size, const At& at) {
  cv::Vec3i sum(0, 0, 0);
  for (int k = -kReach; k <= kReach; ++k) sum += kBinomial[k + kReach] * at(std::clamp(i + k, 0, size - 1));
  return sum;
}

// 256 times the softened Lab picture.
cv::Mat3i softened(const cv::Mat3b& lab) {
  cv::Mat3i across(lab.size()), soft(lab.size());
  cv::parallel_for_({0, lab.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < lab.cols; ++x)
        across(y, x) = weighted(x, lab.cols, [&](int i) { return cv::Vec3i(lab(y, i)); });
  });
  cv::parallel_for_({0, lab.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      for (int x = 0; x < lab.cols; ++x) soft(y, x) = weighted(y, lab.rows, [&](int j) { return across(j, x); });
  });
  return soft;
}

// 256 times the mean colour, rounded.
cv::Vec3i mean_of(const cv::Mat3b& lab) {
  std::array<std::int64_t, 3> sum{};
  for (const cv::Vec3b& pixel : lab)
    for (int c = 0; c < 3; ++c) sum[c] += pixel[c];
  const auto pixels = static_cast<std::int64_t>(lab.total());
  cv::Vec3i mean;
  for (int c = 0; c < 3; ++c) mean[c] = static_cast<int>((256 * sum[c] + pixels / 2) / pixels);
  return mean;
}

}  // namespace

cv::Mat1i saliency_of(const cv::Mat3b& rgb) {
  cv::Mat1i saliency(rgb.size());
  if (rgb.empty()) return saliency;
  const cv::Mat3b lab = lab_of(rgb);
  const cv::Vec3i mean = mean_of(lab);
  const cv::Mat3i soft = softened(lab);
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const cv::Vec3i off = soft(y, x) - mean;
      std::int64_t sum = 0;
      for (int c = 0; c < 3; ++c) sum += std::int64_t{off[c]} * off[c];
      saliency(y, x) = static_cast<int>((sum + (1 << 15)) >> 16);
    }
  return saliency;
}

}  // namespace tessera

#include "tessera/image/palette.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace tessera {
namespace {

// First centres: the sample farthest from the mean, then ever the one farthest from those taken.
cv::Mat1f first_centres(const cv::Mat1f& samples, int colors) {
  cv::Mat1f last, centres(0, 3), nearest(samples.rows, 1, 1e12f);
  cv::reduce(samples, last, 0, cv::REDUCE_AVG);
  for (int k = 0; k < colors; ++k) {
    int farthest = 0;
    for (int i = 0; i < samples.rows; ++i) {
      const float d = static_cast<float>(cv::norm(samples.row(i), last, cv::NORM_L2SQR));
      nearest(i) = k <= 1 ? d : std::min(nearest(i), d);  // the mean itself is no centre
      if (nearest(i) > nearest(farthest)) farthest = i;
    }
    last = samples.row(farthest).clone();
    centres.push_back(last);
  }
  return centres;
}

}  // namespace

cv::Mat1f to_lab(const std::vector<Rgb>& colours) {
  cv::Mat3f rgb(static_cast<int>(colours.size()), 1), lab;
  for (int i = 0; i < rgb.rows; ++i) rgb(i) = cv::Vec3f(colours[i].r, colours[i].g, colours[i].b) * (1.0f / 255);
  cv::cvtColor(rgb, lab, cv::COLOR_RGB2Lab);
  return lab.reshape(1);
}

cv::Mat1f lab_palette(const cv::Mat1f& samples, int colors) {
  cv::Mat1f centres = first_centres(samples, colors);
  cv::Mat1i labels(samples.rows, 1, 0);
  for (int i = 0; i < samples.rows; ++i)
    labels(i) = nearest_colour(centres, {samples(i, 0), samples(i, 1), samples(i, 2)});
  if (samples.rows >= colors)
    cv::kmeans(samples, colors, labels, {cv::TermCriteria::COUNT, 20, 0}, 1, cv::KMEANS_USE_INITIAL_LABELS, centres);
  return centres;
}

int nearest_colour(const cv::Mat1f& palette, const cv::Vec3f& lab) {
  float least = 1e30f;
  int nearest = 0;
  for (int k = 0; k < palette.rows; ++k) {
    const float* c = palette[k];
    const float d =
        (lab[0] - c[0]) * (lab[0] - c[0]) + (lab[1] - c[1]) * (lab[1] - c[1]) + (lab[2] - c[2]) * (lab[2] - c[2]);
    if (d < least) {
      least = d;
      nearest = k;
    }
  }
  return nearest;
}

std::vector<Rgb> to_rgb(const cv::Mat1f& lab) {
  cv::Mat3f rgb;
  cv::cvtColor(cv::Mat3f(lab.clone().reshape(3)), rgb, cv::COLOR_Lab2RGB);
  std::vector<Rgb> colours;
  for (const cv::Vec3f& v : rgb) {
    const cv::Vec3b byte(v * 255);
    colours.push_back({byte[0], byte[1], byte[2]});
  }
  return colours;
}

}  // namespace tessera

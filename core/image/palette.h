// A few colours for many: in Lab, where distances are about what eyes see.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/base/colour.h"

namespace tessera {

// A Lab colour a row (CV_32F, three columns).
cv::Mat1f to_lab(const std::vector<Rgb>& colours);

// `colors` centres of the samples (a Lab colour a row): k-means from well-spread first ones, without random numbers.
cv::Mat1f lab_palette(const cv::Mat1f& samples, int colors);

// The row of `palette` next to a Lab colour, the first among equals.
int nearest_colour(const cv::Mat1f& palette, const cv::Vec3f& lab);

// Lab rows as sRGB.
std::vector<Rgb> to_rgb(const cv::Mat1f& lab);

}  // namespace tessera

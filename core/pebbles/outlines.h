// From labels to outlines r(phi), and back.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tessera/pebbles/pebble.h"

namespace tessera::pebbles {

inline constexpr int kDirections = 64;  // a grain's outline to 3 % of its area; the paper takes 360

// A pebble for each label of `labels` (0 is ground), in the order of their numbers: centre of mass, and in each
// direction the border, evened out where single rays went astray. Ids are the labels; labels without pixels are left
// out; radii are in pixels of `labels`.
std::vector<Pebble> fit_outlines(const cv::Mat1i& labels);

// The same pebbles on a picture `factor` times as large.
void enlarge(double factor, std::vector<Pebble>& pebbles);

// Draws the outlines' insides. A pixel inside two goes to the pebble to whose centre it is nearer, as a share of the
// radius in its direction. Sets each area_px.
cv::Mat1i paint_labels(std::vector<Pebble>& pebbles, cv::Size size);

}  // namespace tessera::pebbles

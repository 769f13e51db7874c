// Edges of pebbles rather than of their texture (section 3.1 of the paper).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace tessera::pebbles {

inline constexpr int kLevels = 256;  // L

// I_L: at how many of the L levels the intensity changes (Eq. 2, with tau `ratio` in (0, 1]), 0 to L, of each pixel.
// A pixel changes at a level where one of its four neighbours reaches the level and it stays below tau times that.
cv::Mat1w level_changes(const cv::Mat1b& intensity, double ratio);

// t_H: the first quartile of `changes`, among the pixels that change at all; 0 where none does.
int first_quartile(const cv::Mat1w& changes);

// 255 where at least `high` levels change, and where at least a third of that do and 8-connected such pixels lead to
// one with `high`; else 0.
cv::Mat1b hysteresis(const cv::Mat1w& changes, int high);

// The mask of a photo (RGB): 255 on edges, else 0. `median_radius`: what is narrower is texture.
cv::Mat1b level_edges(const cv::Mat3b& photo, int median_radius, double ratio);

}  // namespace tessera::pebbles

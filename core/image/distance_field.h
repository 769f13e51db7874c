// Distance from each pixel to the nearest frontier between zones (paper, III.A).
#pragma once

#include <opencv2/core.hpp>

namespace tessera {

// CV_32F, pixels; +inf-like kNoFrontier where the drawing has no frontier at all.
using DistanceField = cv::Mat1f;
inline constexpr float kNoFrontier = 1e6f;

// Exact: Euclidean distance to the nearest pixel on a frontier, plus the half pixel from there to the frontier.
DistanceField exact_distance(const cv::Mat1b& zones);

// Exact distance from each pixel's centre to that of the next pixel of `edges` that is not 0.
DistanceField edge_distance(const cv::Mat1b& edges);

// The paper's: 0.5 beside a frontier, sqrt(2)/2 diagonally, the rest by the quasi-Euclidean 3x3 chamfer transform.
DistanceField chamfer_distance(const cv::Mat1b& zones);

// Unit vector away from the nearest frontier at (x, y) (Eq. 2), by Sobel's operator with a reach of `step` pixels;
// (0, 0) where the field is flat.
cv::Vec2d uphill(const DistanceField& field, double x, double y, int step);

// Value of the field at (x, y), bilinear between pixel centres.
float at(const DistanceField& field, double x, double y);

}  // namespace tessera

// What the borders of a picture's classes look like: the marks by which models of one density differ.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace tessera::statistics {

// Figures without a scale; all but the last two are chances.
using BorderMarks = std::vector<double>;

// `spacing`: mean distance between changes of class along a line, px, at least about 6. Of a border's pixels, how many
// meet another of nearly their direction so many spacings ahead along it (straight borders go on, bent ones turn away,
// lattices come again), for 6 distances; then how alike directions are modulo 90 and modulo 60 degrees, 0 to 1.
// Labels below 16. All are 0 where there are no borders.
BorderMarks border_marks(const cv::Mat1b& labels, double spacing);

}  // namespace tessera::statistics

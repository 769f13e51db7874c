// Cubic Bezier curves along lines of measured points.
#pragma once

#include <array>
#include <vector>

#include "tessera/geometry/polygon.h"

namespace tessera {

// From [0] to [3]; it leaves towards [1] and arrives from [2].
using Bezier = std::array<Point, 4>;

Point point_at(const Bezier& curve, double t);  // t from 0 to 1
Bezier straight(Point from, Point to);

// How curves of a chain meet: at all (G0), or in one direction as well (G1).
enum class Joints { kG0, kG1 };

// Curves one after the other from the line's first point to its last, such that no point of the line is farther than
// `error` (> 0) from them, nor they from the line. An open line of two points or more, none repeated. With kG1 they
// begin and end in the directions `start` and `end`, unit vectors along the line's way; (0, 0): as the line does.
// With kG0 these do not matter.
//
// Least squares by chord length, Newton's steps for the parameters, split where it is worst (P. J. Schneider, "An
// Algorithm for Automatically Fitting Digitized Curves", Graphics Gems 1990). His tolerance is that of the points
// alone; here the curve between them counts, too.
std::vector<Bezier> fit_beziers(const Ring& line, double error, Joints joints, Point start = {}, Point end = {});

// Curves through the points, one from each to the next, that meet in one direction and with one curvature (G2): a
// cubic spline whose parameter is the length of the chords. Two points or more, none repeated. At its ends the spline
// has the directions `start` and `end`, unit vectors; (0, 0): no curvature there (a natural spline).
std::vector<Bezier> spline_through(const Ring& points, Point start = {}, Point end = {});

// Appends points of the curve after its first, up to its last, the lines between them no farther from it than
// `tolerance` (> 0).
void flatten(const Bezier& curve, double tolerance, Ring& line);

}  // namespace tessera

// Lines for machines and paper, in millimetres.
#pragma once

#include <string>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/geometry/polygon.h"

namespace tessera {

// Lines that belong together and have one name; all of them closed, or all open.
struct Stroke {
  std::string id;
  std::vector<Ring> lines;
  bool closed = false;
};

struct DrawingLayer {
  std::string name;  // a plain word
  Rgb colour;
  double width = 0.01;  // of its lines
  std::vector<Stroke> strokes;
  double dash = 0;  // length of its dashes and of what is between them; 0: lines are whole. DXF has whole lines
};

// A sheet of paper that shows a part of the drawing.
struct Page {
  double left = 0, top = 0, width = 0, height = 0;
};

// x right, y down. A valid one has a width and height above 0, finite coordinates below 1e9, unique ids that are
// plain words, lines of two points and more, closed ones of three.
struct Drawing {
  double left = 0, top = 0, width = 0, height = 0;
  std::vector<DrawingLayer> layers;  // the first lies undermost and is worked first
  std::vector<Page> pages;           // none: the drawing is one
  std::string job_json;              // the job that made it, one JSON object; empty: none
};

}  // namespace tessera

// Writers: a sheet of pieces in, the bytes of a file out. They never fail on a valid sheet and touch no file.
//
// A valid sheet has finite coordinates below 1e9, rings of at least three vertices, a width and height above 0, and
// plain words (letters, digits, '-', '_') for `kind` and `layer`; its job_json is empty or one JSON object in UTF-8.
// Numbers are written with at most 3 decimals and no exponent. Memory is that of the result, and for a picture of its
// pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tessera/geometry/drawing.h"
#include "tessera/geometry/piece.h"
#include "tessera/geometry/raster.h"
#include "tessera/geometry/scene.h"

namespace tessera {

// SVG 1.1 with Inkscape layers: a rect in layer `grout`, one <path> a piece above it, the job in <metadata>. The
// viewBox is in source pixels; width and height are in mm where the sheet has a width_mm.
std::string write_svg(const PieceSheet& sheet);
// The same in parts, for pieces that are not there all at once: what comes before the pieces, some pieces (those of
// the sheet), what comes after them.
std::string svg_head(const PieceSheet& sheet);
void append_svg_pieces(std::string& out, const PieceSheet& sheet);
std::string svg_foot();
// DXF R2000, one closed LWPOLYLINE a ring, a layer a colour, millimetres, y up. Without width_mm 1 px is 1 mm. A
// layer has the nearest of AutoCAD's 255 colours, its name the true one; more than 255 colours are merged into those.
std::string write_dxf(const PieceSheet& sheet);
// A drawing as SVG 1.1, width and height in mm as the viewBox is: an Inkscape layer a layer, one <path> a stroke; and
// as DXF R2000, one LWPOLYLINE a line, y up, both within the same frame.
std::string write_svg(const Drawing& drawing);
std::string write_dxf(const Drawing& drawing);
// GeoJSON FeatureCollection, one Feature a piece, coordinates in source pixels (y down). The bbox is the sheet. Of a
// sheet of points the geometries are these.
std::string write_geojson(const PieceSheet& sheet);
// CSV with a header, one row a piece: id,colour,area_px2,perimeter_px,vertices,orientation_deg,centroid_x,centroid_y.
// Perimeter and vertices include those of holes.
std::string write_csv(const PieceSheet& sheet);
// CSV with a header, one row a colour, the largest area first: colour,name,count,area_px2,area_mm2,share. Areas in
// mm2 are left empty where the sheet has no width_mm; `share` is of the pieces' area.
std::string write_bill_csv(const PieceSheet& sheet);
// PNG of a picture as it is; 0 pixels a metre: unknown.
std::string write_png(const Raster& raster, double pixels_per_metre = 0);
// The picture of a sheet, as its PNG has it.
Raster draw_sheet(const PieceSheet& sheet, double scale = 1);
// Those pixels of that picture that are in a part of it, which lies within it and has some.
struct PicturePart {
  int left = 0, top = 0, width = 0, height = 0;
};
Raster draw_sheet(const PieceSheet& sheet, double scale, const PicturePart& part);
// PNG picture of the sheet, 8 bits in each of its channels or, of pieces of one colour, with a palette, anti-aliased
// by exact coverage, `scale` output pixels a source pixel (> 0).
std::string write_png(const PieceSheet& sheet, double scale = 1);

// glTF 2.0 as one binary file, and as one text that holds its buffer. Textures are JPEG. A valid scene has finite
// numbers, indices within their lists, lists of a mesh as long as its positions (> 0), triangles, a view and a mesh
// for each node. Uses KHR_mesh_quantization where the scene wants it, EXT_mesh_gpu_instancing for instances,
// OMI_collider for hulls; the job, as text, is `job` of the asset's extras.
std::string write_glb(const Scene& scene);
std::string write_gltf(const Scene& scene);
// The way to the sheet as an animated PNG, again and again: the sheet, drawn as large as the frames, for two seconds,
// then the frames, 8-bit RGB, all of one size, ten a second. Programs that know no animation show the sheet. Without
// frames the sheet alone, `scale` output pixels a source pixel. Frames are drawn one after the other: all of them
// take much memory.
struct Frames {
  int count = 0;
  std::function<Raster(int index)> draw = {};
};
std::string write_apng(const PieceSheet& sheet, const Frames& frames, double scale = 1);

// One or more histograms over the same bins, as an SVG plot with axes and a legend. Values are finite and >= 0.
struct Histogram {
  std::string title, x_label, y_label;
  std::vector<std::string> bins;  // bin labels
  struct Series {
    std::string name;
    std::vector<double> values;  // one a bin
  };
  std::vector<Series> series;
};
std::string write_histogram_svg(const Histogram& histogram);

// Curves through points in their order, as an SVG plot with axes, a legend and single places marked. Values are
// finite, x on a logarithmic axis above 0.
struct Curves {
  std::string title, x_label, y_label;
  bool logarithmic = false;  // the axis of x; that of y is linear and has 0
  struct Series {
    std::string name;
    std::vector<Point> points;
  };
  std::vector<Series> series;
  struct Mark {
    std::string label;
    Point at;
  };
  std::vector<Mark> marks = {};
};
std::string write_curves_svg(const Curves& curves);

}  // namespace tessera

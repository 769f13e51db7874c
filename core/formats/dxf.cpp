#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/formats/formats.h"
#include "tessera/formats/text.h"

namespace tessera {
namespace {

using Handle = std::uint64_t;

// Objects that every drawing has; layers and entities follow from kFirstFree.
enum : Handle {
  kNone = 0,
  kBlockRecords = 1,
  kLayers,
  kStyles,
  kLineTypes,
  kViews,
  kCoordinateSystems,
  kViewports,
  kApplications,
  kDimensionStyles,
  kRootDictionary,
  kGroups,
  kPlotStyles,
  kNormalPlotStyle,
  kLayerZero,
  kStandardStyle,
  kByBlock,
  kByLayer,
  kContinuous,
  kActiveViewport,
  kAcadApplication,
  kStandardDimensions,
  kModelSpace,
  kModelBlock,
  kModelBlockEnd,
  kPaperSpace,
  kPaperBlock,
  kPaperBlockEnd,
  kFirstFree = 0x40
};

// Appends pairs of group code and value, each on a line of its own.
class Tags {
 public:
  explicit Tags(std::string& out) : out_(out) {}

  Tags& text(int code, std::string_view value) {
    start(code);
    out_ += value;
    out_ += '\n';
    return *this;
  }
  Tags& integer(int code, std::int64_t value) {
    start(code);
    append_integer(out_, value);
    out_ += '\n';
    return *this;
  }
  Tags& number(int code, double value) {
    start(code);
    append_number(out_, value);
    out_ += '\n';
    return *this;
  }
  Tags& handle(int code, Handle value) {
    char buffer[16];
    const char* const end = std::to_chars(buffer, buffer + sizeof buffer, value, 16).ptr;
    return text(code, {buffer, static_cast<std::size_t>(end - buffer)});
  }
  // x with the group code, y with that plus 10.
  Tags& point(int code, double x, double y) { return number(code, x).number(code + 10, y); }

 private:
  void start(int code) {
    append_integer(out_, code);
    out_ += '\n';
  }

  std::string& out_;
};

// ---- Colours

std::uint32_t packed(Rgb c) { return static_cast<std::uint32_t>(c.r << 16 | c.g << 8 | c.b); }

Rgb unpacked(std::uint32_t c) {
  return {static_cast<std::uint8_t>(c >> 16), static_cast<std::uint8_t>(c >> 8), static_cast<std::uint8_t>(c)};
}

// Entries 10 to 249 of AutoCAD's colour index: 24 hues, each in 5 values, each pure and mixed half and half with
// white.
Rgb hue_entry(int index) {
  constexpr int kValues[] = {255, 165, 127, 76, 38};
  const int hue = (index - 10) / 10 * 15, value = kValues[index % 10 / 2];
  const auto channel = [&](int peak) {
    const int apart = std::abs(hue - peak) <= 180 ? std::abs(hue - peak) : 360 - std::abs(hue - peak);
    const int level = value * std::clamp(120 - apart, 0, 60) / 60;
    return static_cast<std::uint8_t>(index % 2 == 0 ? level : (value + level) / 2);
  };
  return {channel(0), channel(120), channel(240)};
}

Rgb index_colour(int index) {
  constexpr Rgb kFirst[] = {{255, 0, 0}, {255, 255, 0}, {0, 255, 0}, {0, 255, 255}, {0, 0, 255}, {255, 0, 255}};
  constexpr std::uint8_t kGreys[] = {51, 91, 132, 173, 214, 255};
  if (index <= 6) return kFirst[index - 1];
  if (index < 10) return index == 8 ? Rgb{128, 128, 128} : Rgb{192, 192, 192};
  if (index < 250) return hue_entry(index);
  const std::uint8_t grey = kGreys[index - 250];
  return {grey, grey, grey};
}

// Squared difference of brightness, and four times that of hue: greys stay grey.
int difference(Rgb a, Rgb b) {
  const int red = a.r - b.r, green = a.g - b.g, blue = a.b - b.b;
  const auto square = [](int v) { return v * v; };
  return square(red + green + blue) / 9 + 4 * (square(red - green) + square(green - blue) + square(blue - red));
}

// Index 7 is left out: it is black or white as the background demands.
int nearest_index(Rgb colour) {
  int best = 1;
  for (int index = 2; index <= 255; ++index)
    if (index != 7 && difference(colour, index_colour(index)) < difference(colour, index_colour(best))) best = index;
  return best;
}

// ---- The pieces' layers, one a colour

class ColourLayers {
 public:
  explicit ColourLayers(const PieceSheet& sheet) : stem_(sheet.layer + "-") {
    for (const Piece& piece : sheet.pieces) colours_.push_back(packed(piece.fill));
    make_distinct();
    merged_ = colours_.size() > 255;
    if (!merged_) return;
    for (std::uint32_t& colour : colours_) colour = packed(index_colour(nearest_index(unpacked(colour))));
    make_distinct();
  }

  const std::vector<std::uint32_t>& colours() const { return colours_; }
  // "stones-1a2b3c"
  std::string name(Rgb fill) const {
    std::string colour;
    append_colour(colour, merged_ ? index_colour(nearest_index(fill)) : fill);
    return stem_ + colour.substr(1);
  }

 private:
  void make_distinct() {
    std::sort(colours_.begin(), colours_.end());
    colours_.erase(std::unique(colours_.begin(), colours_.end()), colours_.end());
  }

  std::string stem_;
  std::vector<std::uint32_t> colours_;  // sorted
  bool merged_ = false;
};

// ---- Sections

// What is drawn in millimetres, y up.
struct Frame {
  double scale, left, right, bottom, top;
  double origin;  // where y is 0

  explicit Frame(const PieceSheet& sheet)
      : scale(sheet.width_mm > 0 ? sheet.width_mm / sheet.width : 1),
        left(0),
        right(sheet.width * scale),
        bottom(0),
        top(sheet.height * scale),
        origin(top) {}
  // The lower side stays at `top` and the upper one at `top` + `height`: y alone changes its sense, within the frame.
  explicit Frame(const Drawing& drawing)
      : scale(1),
        left(drawing.left),
        right(drawing.left + drawing.width),
        bottom(drawing.top),
        top(drawing.top + drawing.height),
        origin(2 * drawing.top + drawing.height) {}
  Point operator()(Point p) const { return {scale * p.x, origin - scale * p.y}; }
};

struct Layer {
  std::string name;
  int colour_index;
};

std::size_t ring_count(const PieceSheet& sheet) {
  std::size_t rings = 0;
  for (const Piece& piece : sheet.pieces) rings += 1 + piece.outline.holes.size();
  return rings;
}

void append_header(Tags tags, const Frame& frame, Handle next_free) {
  tags.text(0, "SECTION").text(2, "HEADER");
  tags.text(9, "$ACADVER").text(1, "AC1015");
  tags.text(9, "$DWGCODEPAGE").text(3, "ANSI_1252");
  tags.text(9, "$HANDSEED").handle(5, next_free);
  tags.text(9, "$INSUNITS").integer(70, 4);     // millimetres
  tags.text(9, "$MEASUREMENT").integer(70, 1);  // metric
  tags.text(9, "$EXTMIN").point(10, frame.left, frame.bottom).number(30, 0);
  tags.text(9, "$EXTMAX").point(10, frame.right, frame.top).number(30, 0);
  tags.text(9, "$LIMMIN").point(10, frame.left, frame.bottom);
  tags.text(9, "$LIMMAX").point(10, frame.right, frame.top);
  tags.text(0, "ENDSEC");
}

void append_class(Tags tags, std::string_view name, std::string_view cpp_name) {
  tags.text(0, "CLASS").text(1, name).text(2, cpp_name).text(3, "ObjectDBX Classes");
  tags.integer(90, 0).integer(280, 0).integer(281, 0);
}

void append_classes(Tags tags) {
  tags.text(0, "SECTION").text(2, "CLASSES");
  append_class(tags, "ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault");
  append_class(tags, "ACDBPLACEHOLDER", "AcDbPlaceHolder");
  tags.text(0, "ENDSEC");
}

void append_table(Tags tags, std::string_view name, Handle handle, std::size_t records) {
  tags.text(0, "TABLE").text(2, name).handle(5, handle).handle(330, kNone).text(100, "AcDbSymbolTable");
  tags.integer(70, static_cast<std::int64_t>(records));
}

Tags append_record(Tags tags, std::string_view type, Handle handle, Handle table, std::string_view subclass,
                   std::string_view name) {
  const int handle_code = type == "DIMSTYLE" ? 105 : 5;
  tags.text(0, type).handle(handle_code, handle).handle(330, table).text(100, "AcDbSymbolTableRecord");
  return tags.text(100, subclass).text(2, name);
}

void append_viewport_table(Tags tags, const Frame& frame) {
  append_table(tags, "VPORT", kViewports, 1);
  append_record(tags, "VPORT", kActiveViewport, kViewports, "AcDbViewportTableRecord", "*ACTIVE").integer(70, 0);
  const double width = frame.right - frame.left, height = frame.top - frame.bottom;
  tags.point(10, 0, 0).point(11, 1, 1);                               // corners on the screen
  tags.point(12, frame.left + width / 2, frame.bottom + height / 2);  // its centre
  tags.point(13, 0, 0).point(14, 10, 10).point(15, 10, 10);           // snap and grid
  tags.point(16, 0, 0).number(36, 1);                                 // seen from above
  tags.point(17, 0, 0).number(37, 0);
  tags.number(40, height * 1.05).number(41, std::max(0.1, width / height));
  tags.text(0, "ENDTAB");
}

void append_line_type_table(Tags tags) {
  append_table(tags, "LTYPE", kLineTypes, 3);
  for (const auto& [handle, name] :
       {std::pair{kByBlock, "ByBlock"}, {kByLayer, "ByLayer"}, {kContinuous, "Continuous"}}) {
    append_record(tags, "LTYPE", handle, kLineTypes, "AcDbLinetypeTableRecord", name).integer(70, 0);
    tags.text(3, "").integer(72, 65).integer(73, 0).number(40, 0);
  }
  tags.text(0, "ENDTAB");
}

void append_layer(Tags tags, Handle handle, std::string_view name, int colour_index) {
  append_record(tags, "LAYER", handle, kLayers, "AcDbLayerTableRecord", name).integer(70, 0);
  tags.integer(62, colour_index).text(6, "Continuous").integer(370, -3).handle(390, kNormalPlotStyle);
}

void append_layer_table(Tags tags, const std::vector<Layer>& layers) {
  append_table(tags, "LAYER", kLayers, 1 + layers.size());
  append_layer(tags, kLayerZero, "0", 7);
  Handle handle = kFirstFree;
  for (const Layer& layer : layers) append_layer(tags, handle++, layer.name, layer.colour_index);
  tags.text(0, "ENDTAB");
}

void append_tables(Tags tags, const Frame& frame, const std::vector<Layer>& layers) {
  tags.text(0, "SECTION").text(2, "TABLES");
  append_viewport_table(tags, frame);
  append_line_type_table(tags);
  append_layer_table(tags, layers);
  append_table(tags, "STYLE", kStyles, 1);
  append_record(tags, "STYLE", kStandardStyle, kStyles, "AcDbTextStyleTableRecord", "Standard").integer(70, 0);
  tags.number(40, 0).number(41, 1).number(50, 0).integer(71, 0).number(42, 2.5).text(3, "txt").text(4, "");
  tags.text(0, "ENDTAB");
  append_table(tags, "VIEW", kViews, 0);
  tags.text(0, "ENDTAB");
  append_table(tags, "UCS", kCoordinateSystems, 0);
  tags.text(0, "ENDTAB");
  append_table(tags, "APPID", kApplications, 1);
  append_record(tags, "APPID", kAcadApplication, kApplications, "AcDbRegAppTableRecord", "ACAD").integer(70, 0);
  tags.text(0, "ENDTAB");
  append_table(tags, "DIMSTYLE", kDimensionStyles, 1);
  tags.text(100, "AcDbDimStyleTable").integer(71, 1);
  append_record(tags, "DIMSTYLE", kStandardDimensions, kDimensionStyles, "AcDbDimStyleTableRecord", "Standard")
      .integer(70, 0)
      .handle(340, kStandardStyle);
  tags.text(0, "ENDTAB");
  append_table(tags, "BLOCK_RECORD", kBlockRecords, 2);
  append_record(tags, "BLOCK_RECORD", kModelSpace, kBlockRecords, "AcDbBlockTableRecord", "*Model_Space");
  append_record(tags, "BLOCK_RECORD", kPaperSpace, kBlockRecords, "AcDbBlockTableRecord", "*Paper_Space");
  tags.text(0, "ENDTAB").text(0, "ENDSEC");
}

void append_block(Tags tags, std::string_view name, Handle record, Handle begin, Handle end) {
  tags.text(0, "BLOCK").handle(5, begin).handle(330, record).text(100, "AcDbEntity").text(8, "0");
  tags.text(100, "AcDbBlockBegin")
      .text(2, name)
      .integer(70, 0)
      .point(10, 0, 0)
      .number(30, 0)
      .text(3, name)
      .text(1, "");
  tags.text(0, "ENDBLK").handle(5, end).handle(330, record).text(100, "AcDbEntity").text(8, "0");
  tags.text(100, "AcDbBlockEnd");
}

void append_blocks(Tags tags) {
  tags.text(0, "SECTION").text(2, "BLOCKS");
  append_block(tags, "*Model_Space", kModelSpace, kModelBlock, kModelBlockEnd);
  append_block(tags, "*Paper_Space", kPaperSpace, kPaperBlock, kPaperBlockEnd);
  tags.text(0, "ENDSEC");
}

void append_polyline(Tags tags, const Frame& frame, Handle handle, std::string_view layer, const Ring& ring,
                     bool closed = true) {
  tags.text(0, "LWPOLYLINE").handle(5, handle).handle(330, kModelSpace).text(100, "AcDbEntity").text(8, layer);
  tags.text(100, "AcDbPolyline").integer(90, static_cast<std::int64_t>(ring.size())).integer(70, closed);
  for (const Point p : ring) {
    const Point at = frame(p);
    tags.point(10, at.x, at.y);
  }
}

void append_entities(Tags tags, const PieceSheet& sheet, const Frame& frame, const ColourLayers& layers,
                     Handle handle) {
  tags.text(0, "SECTION").text(2, "ENTITIES");
  for (const Piece& piece : sheet.pieces) {
    const std::string layer = layers.name(piece.fill);
    append_polyline(tags, frame, handle++, layer, piece.outline.outer);
    for (const Ring& hole : piece.outline.holes) append_polyline(tags, frame, handle++, layer, hole);
  }
  tags.text(0, "ENDSEC");
}

void append_entities(Tags tags, const Drawing& drawing, const Frame& frame, Handle handle) {
  tags.text(0, "SECTION").text(2, "ENTITIES");
  for (const DrawingLayer& layer : drawing.layers)
    for (const Stroke& stroke : layer.strokes)
      for (const Ring& line : stroke.lines) append_polyline(tags, frame, handle++, layer.name, line, stroke.closed);
  tags.text(0, "ENDSEC");
}

void append_objects(Tags tags) {
  tags.text(0, "SECTION").text(2, "OBJECTS");
  tags.text(0, "DICTIONARY")
      .handle(5, kRootDictionary)
      .handle(330, kNone)
      .text(100, "AcDbDictionary")
      .integer(281, 1);
  tags.text(3, "ACAD_GROUP").handle(350, kGroups).text(3, "ACAD_PLOTSTYLENAME").handle(350, kPlotStyles);
  tags.text(0, "DICTIONARY")
      .handle(5, kGroups)
      .handle(330, kRootDictionary)
      .text(100, "AcDbDictionary")
      .integer(281, 1);
  tags.text(0, "ACDBDICTIONARYWDFLT").handle(5, kPlotStyles).handle(330, kRootDictionary);
  tags.text(100, "AcDbDictionary").integer(281, 1).text(3, "Normal").handle(350, kNormalPlotStyle);
  tags.text(100, "AcDbDictionaryWithDefault").handle(340, kNormalPlotStyle);
  tags.text(0, "ACDBPLACEHOLDER").handle(5, kNormalPlotStyle).handle(330, kPlotStyles);
  tags.text(0, "ENDSEC").text(0, "EOF");
}

}  // namespace

std::string write_dxf(const PieceSheet& sheet) {
  const Frame frame(sheet);
  const ColourLayers colours(sheet);
  std::vector<Layer> layers;
  for (const std::uint32_t colour : colours.colours())
    layers.push_back({colours.name(unpacked(colour)), nearest_index(unpacked(colour))});
  const Handle first_entity = kFirstFree + layers.size();
  std::string out;
  out.reserve(8192 + 160 * layers.size() + room_for(sheet, 112 + sheet.layer.size(), 26));
  Tags tags(out);
  append_header(tags, frame, first_entity + ring_count(sheet));
  append_classes(tags);
  append_tables(tags, frame, layers);
  append_blocks(tags);
  append_entities(tags, sheet, frame, colours, first_entity);
  append_objects(tags);
  return out;
}

std::string write_dxf(const Drawing& drawing) {
  const Frame frame(drawing);
  std::vector<Layer> layers;
  std::size_t lines = 0;
  for (const DrawingLayer& layer : drawing.layers) {
    layers.push_back({layer.name, nearest_index(layer.colour)});
    for (const Stroke& stroke : layer.strokes) lines += stroke.lines.size();
  }
  const Handle first_entity = kFirstFree + layers.size();
  std::string out;
  Tags tags(out);
  append_header(tags, frame, first_entity + lines);
  append_classes(tags);
  append_tables(tags, frame, layers);
  append_blocks(tags);
  append_entities(tags, drawing, frame, first_entity);
  append_objects(tags);
  return out;
}

}  // namespace tessera

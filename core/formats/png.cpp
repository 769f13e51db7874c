#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tessera/formats/coverage.h"
#include "tessera/formats/formats.h"
#include "tessera/formats/picture.h"

namespace tessera {
namespace {

Polygon moved(Polygon outline, Point way) {
  for (Point& p : outline.outer) p += way;
  for (Ring& hole : outline.holes)
    for (Point& p : hole) p += way;
  return outline;
}

// Where else on a seamless sheet an outline shows that sticks out of it.
std::vector<Polygon> copies_across(const PieceSheet& sheet, const Polygon& outline) {
  const auto [least, most] = bounds_of(outline.outer);
  // Shifted by so many sheets, [from, to], it meets the sheet.
  const auto from = [](double end, double size) { return static_cast<int>(std::ceil(-end / size)); };
  const auto to = [](double begin, double size) { return static_cast<int>(std::floor((size - begin) / size)); };
  std::vector<Polygon> copies;
  for (int j = from(most.y, sheet.height); j <= to(least.y, sheet.height); ++j)
    for (int i = from(most.x, sheet.width); i <= to(least.x, sheet.width); ++i) {
      if (i == 0 && j == 0) continue;
      copies.push_back(moved(outline, {i * sheet.width, j * sheet.height}));
    }
  return copies;
}

Rgb fill_of(const Piece& piece) { return piece.fill; }
Rgb opacity_of(const Piece& piece) { return {piece.opacity, piece.opacity, piece.opacity}; }

// `paint_of` says with what a piece is painted.
template <class Pixels, class PaintOf>
void draw_pieces(const PieceSheet& sheet, double scale, const PaintOf& paint_of, Pixels& pixels) {
  Coverage coverage(static_cast<int>(pixels.width()), static_cast<int>(pixels.height()));
  for (const Piece& piece : sheet.pieces) {
    const auto paint = [&](int x, int y, float share) { pixels.paint(x, y, paint_of(piece), share); };
    coverage.each_pixel(piece.outline, scale, paint);
    if (!sheet.seamless) continue;
    for (const Polygon& copy : copies_across(sheet, piece.outline)) coverage.each_pixel(copy, scale, paint);
  }
}

int pixels_of(double length, double scale) { return std::max(1, static_cast<int>(std::lround(length * scale))); }

Picture draw(const PieceSheet& sheet, double scale, int width, int height) {
  Picture picture(width, height, sheet.grout);
  draw_pieces(sheet, scale, fill_of, picture);
  return picture;
}

Picture draw(const PieceSheet& sheet, double scale) {
  return draw(sheet, scale, pixels_of(sheet.width, scale), pixels_of(sheet.height, scale));
}

// One channel of a picture, 0 to 2, as number `channel` of so many in a raster.
void copy_channel(const Picture& from, std::size_t number, Raster& to, std::size_t channel) {
  const auto channels = static_cast<std::size_t>(to.channels);
  for (std::size_t y = 0; y < from.height(); ++y)
    for (std::size_t x = 0; x < from.width(); ++x)
      to.bytes[(y * from.width() + x) * channels + channel] = from.scanline(y)[1 + 3 * x + number];
}

bool is_of_one_colour(const PieceSheet& sheet) {
  return sheet.channels == 3 && !sheet.pieces.empty() &&
         std::all_of(sheet.pieces.begin(), sheet.pieces.end(),
                     [&](const Piece& piece) { return piece.fill == sheet.pieces[0].fill; });
}

// ---- The file (PNG specification, chapters 5 and 11; third edition for animation)

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

void append_u32(std::string& out, std::uint64_t value) {
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(value >> shift & 255);
}

void append_u16(std::string& out, unsigned value) {
  for (const unsigned shift : {8U, 0U}) out += static_cast<char>(value >> shift & 255);
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_u32(out, data.size());
  const std::size_t start = out.size();
  out += type;
  out += data;
  append_u32(out, crc32(0, reinterpret_cast<const Bytef*>(&out[start]), static_cast<uInt>(out.size() - start)));
}

enum ColourType : char { kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6 };
constexpr ColourType kTypeOfChannels[] = {kGrey, kGreyAlpha, kRgb, kRgba};

void append_header(std::string& out, std::size_t width, std::size_t height, int bits, ColourType type) {
  std::string data;
  append_u32(data, width);
  append_u32(data, height);
  data += static_cast<char>(bits);
  data += static_cast<char>(type);
  data += std::string_view("\x00\x00\x00", 3);  // deflate, filter a line, not interlaced
  append_chunk(out, "IHDR", data);
}

void append_header(std::string& out, const Picture& picture) {
  append_header(out, picture.width(), picture.height(), 8, kRgb);
}

// 0: unknown.
void append_resolution(std::string& out, double pixels_per_metre) {
  if (pixels_per_metre <= 0) return;
  std::string data;
  const auto resolution = static_cast<std::uint64_t>(std::clamp(pixels_per_metre + 0.5, 1.0, 2e9));
  append_u32(data, resolution);
  append_u32(data, resolution);
  data += '\x01';  // a metre
  append_chunk(out, "pHYs", data);
}

double per_metre(const PieceSheet& sheet, double scale) {
  return sheet.width_mm > 0 ? 1000 * scale * sheet.width / sheet.width_mm : 0;
}

// Lines of `stride` bytes, the filter's number and the pixels, compressed in parts: part(bytes) each time that the
// compressor has filled one.
template <class Scanline, class Part>
void compress(std::size_t height, std::size_t stride, const Scanline& scanline, const Part& part) {
  constexpr int kLevel = 1;  // a quarter of the time of 6 for an eighth more bytes
  z_stream stream{};
  [[maybe_unused]] int status = deflateInit(&stream, kLevel);
  assert(status == Z_OK);
  std::string chunk(std::size_t{1} << 18, '\0');
  const auto start_chunk = [&] {
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
  };
  const auto end_chunk = [&] { part(std::string_view{chunk.data(), chunk.size() - stream.avail_out}); };
  start_chunk();
  for (std::size_t y = 0; y < height; ++y) {
    stream.next_in = const_cast<Bytef*>(scanline(y));
    stream.avail_in = static_cast<uInt>(stride);
    const int flush = y + 1 < height ? Z_NO_FLUSH : Z_FINISH;
    for (status = deflate(&stream, flush); stream.avail_out == 0; status = deflate(&stream, flush)) {
      end_chunk();
      start_chunk();
    }
  }
  assert(status == Z_STREAM_END);
  end_chunk();
  deflateEnd(&stream);
}

template <class Pixels, class Part>
void compress(const Pixels& pixels, const Part& part) {
  compress(
      pixels.height(), pixels.stride(), [&](std::size_t y) { return pixels.scanline(y); }, part);
}

template <class Pixels>
void append_pixels(std::string& out, const Pixels& pixels) {
  compress(pixels, [&](std::string_view part) { append_chunk(out, "IDAT", part); });
}

void append_animation(std::string& out, std::size_t frames) {
  std::string data;
  append_u32(data, frames);
  append_u32(data, 0);  // endlessly
  append_chunk(out, "acTL", data);
}

// Says of the next frame that it covers the whole picture and stays for so long. All chunks of an animation are
// numbered by `sequence`.
void append_frame_control(std::string& out, const Picture& picture, unsigned hundredths, std::uint32_t& sequence) {
  std::string data;
  append_u32(data, sequence++);
  append_u32(data, picture.width());
  append_u32(data, picture.height());
  append_u32(data, 0);
  append_u32(data, 0);
  append_u16(data, hundredths);
  append_u16(data, 100);
  data += std::string_view("\0\0", 2);  // left as it is, and replaced by the next
  append_chunk(out, "fcTL", data);
}

void append_frame(std::string& out, const Picture& picture, std::uint32_t& sequence) {
  compress(picture, [&](std::string_view part) {
    std::string data;
    append_u32(data, sequence++);
    data += part;
    append_chunk(out, "fdAT", data);
  });
}

}  // namespace

std::string write_png(const PieceSheet& sheet, double scale) {
  if (sheet.channels != 3) return write_png(draw_sheet(sheet, scale), per_metre(sheet, scale));
  std::string out(kSignature);
  if (is_of_one_colour(sheet)) {
    Shades shades(pixels_of(sheet.width, scale), pixels_of(sheet.height, scale), sheet.grout, sheet.pieces[0].fill);
    draw_pieces(sheet, scale, fill_of, shades);
    append_header(out, shades.width(), shades.height(), 8, kPalette);
    append_resolution(out, per_metre(sheet, scale));
    append_chunk(out, "PLTE", shades.palette());
    append_pixels(out, shades);
  } else {
    const Picture picture = draw(sheet, scale);
    append_header(out, picture);
    append_resolution(out, per_metre(sheet, scale));
    append_pixels(out, picture);
  }
  append_chunk(out, "IEND", {});
  return out;
}

Raster draw_sheet(const PieceSheet& sheet, double scale) {
  const Picture picture = draw(sheet, scale);
  Raster raster{static_cast<int>(picture.width()), static_cast<int>(picture.height()), sheet.channels, 8, {}};
  raster.bytes.resize(picture.width() * picture.height() * static_cast<std::size_t>(sheet.channels));
  const std::size_t colours = sheet.channels < 3 ? 1 : 3;
  for (std::size_t k = 0; k < colours; ++k) copy_channel(picture, k, raster, k);
  if (sheet.channels % 2 == 0) {
    Picture opacity(raster.width, raster.height, {sheet.grout_opacity, sheet.grout_opacity, sheet.grout_opacity});
    draw_pieces(sheet, scale, opacity_of, opacity);
    copy_channel(opacity, 0, raster, colours);
  }
  return raster;
}

Raster draw_sheet(const PieceSheet& sheet, double scale, const PicturePart& part) {
  const Point origin{part.left / scale, part.top / scale}, size{part.width / scale, part.height / scale};
  PieceSheet seen;
  seen.width = size.x;
  seen.height = size.y;
  seen.grout = sheet.grout;
  seen.grout_opacity = sheet.grout_opacity;
  seen.channels = sheet.channels;
  const auto add = [&](const Piece& piece, const Polygon& outline) {
    const auto [least, most] = bounds_of(outline.outer);
    if (most.x < origin.x || most.y < origin.y || least.x > origin.x + size.x || least.y > origin.y + size.y) return;
    seen.pieces.push_back({piece.id, moved(outline, -1 * origin), piece.fill, piece.opacity});
  };
  for (const Piece& piece : sheet.pieces) {
    add(piece, piece.outline);
    if (!sheet.seamless) continue;
    for (const Polygon& copy : copies_across(sheet, piece.outline)) add(piece, copy);
  }
  return draw_sheet(seen, scale);
}

std::string write_png(const Raster& raster, double pixels_per_metre) {
  constexpr std::uint8_t kUp = 2;  // each byte less the one above: photos and labels repeat themselves downwards
  const auto height = static_cast<std::size_t>(raster.height);
  const std::size_t row = raster.bytes.size() / height;
  std::vector<std::uint8_t> line(1 + row);
  const auto scanline = [&](std::size_t y) {
    line[0] = kUp;
    for (std::size_t i = 0; i < row; ++i) {
      const int above = y > 0 ? raster.bytes[(y - 1) * row + i] : 0;
      line[1 + i] = static_cast<std::uint8_t>(raster.bytes[y * row + i] - above);
    }
    return line.data();
  };
  std::string out(kSignature);
  append_header(out, static_cast<std::size_t>(raster.width), height, raster.bits,
                kTypeOfChannels[raster.channels - 1]);
  append_resolution(out, pixels_per_metre);
  compress(height, line.size(), scanline, [&](std::string_view part) { append_chunk(out, "IDAT", part); });
  append_chunk(out, "IEND", {});
  return out;
}

std::string write_apng(const PieceSheet& sheet, const Frames& frames, double scale) {
  constexpr unsigned kSheetHundredths = 200, kFrameHundredths = 10;
  const auto as_large_as = [&](const Raster& frame) {
    return draw(sheet, frame.width / sheet.width, frame.width, frame.height);
  };
  const Picture picture = frames.count == 0 ? draw(sheet, scale) : as_large_as(frames.draw(0));
  std::uint32_t sequence = 0;
  std::string out(kSignature);
  append_header(out, picture);
  append_animation(out, static_cast<std::size_t>(frames.count) + 1);
  append_frame_control(out, picture, kSheetHundredths, sequence);
  append_pixels(out, picture);
  for (int i = 0; i < frames.count; ++i) {
    append_frame_control(out, picture, kFrameHundredths, sequence);
    append_frame(out, Picture(frames.draw(i)), sequence);
  }
  append_chunk(out, "IEND", {});
  return out;
}

}  // namespace tessera

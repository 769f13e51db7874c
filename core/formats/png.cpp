#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tessera/formats/coverage.h"
#include "tessera/formats/formats.h"

namespace tessera {
namespace {

// ---- The picture

// RGB pixels that start as grout. Pieces do not overlap, so where several touch a pixel each takes its share of the
// grout that is left: no grout shines through where two pieces join. Where they do overlap, the later one lies on
// top.
class Picture {
 public:
  Picture(int width, int height, Rgb grout)
      : width_(static_cast<std::size_t>(width)),
        height_(static_cast<std::size_t>(height)),
        grout_{grout.r, grout.g, grout.b},
        covered_(width_ * height_, 0) {
    scanlines_.reserve(height_ * stride());
    scanlines_.push_back(kNoFilter);
    for (std::size_t x = 0; x < width_; ++x) scanlines_.insert(scanlines_.end(), grout_, grout_ + 3);
    scanlines_.resize(height_ * stride());
    for (std::size_t y = 1; y < height_; ++y) std::copy_n(scanline(0), stride(), &scanlines_[y * stride()]);
  }

  explicit Picture(const Raster& frame) : Picture(frame.width, frame.height, {}) {
    for (std::size_t y = 0; y < height_; ++y)
      std::copy_n(&frame.bytes[3 * y * width_], 3 * width_, &scanlines_[y * stride() + 1]);
  }

  // Lays `colour` over that share of the pixel, 0..1.
  void paint(int x, int y, Rgb colour, float share) {
    const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
    std::uint8_t& covered = covered_[row * width_ + column];
    std::uint8_t* const pixel = &scanlines_[row * stride() + 1 + 3 * column];
    const std::uint8_t fill[] = {colour.r, colour.g, colour.b};
    if (share >= 1) {
      std::copy_n(fill, 3, pixel);
      covered = 255;
      return;
    }
    const float before = static_cast<float>(covered) / 255;
    const float excess = std::max(0.0F, before + share - 1);
    const float keep = excess > 0 ? 1 - excess / before : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const float grout = grout_[k];
      pixel[k] = rounded(grout + keep * (static_cast<float>(pixel[k]) - grout) +
                         share * (static_cast<float>(fill[k]) - grout));
    }
    covered = rounded(255 * std::min(1.0F, before + share));
  }

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  std::size_t stride() const { return 1 + 3 * width_; }
  // As PNG compresses it: the filter's number, then the pixels.
  const std::uint8_t* scanline(std::size_t y) const { return &scanlines_[y * stride()]; }

 private:
  static constexpr std::uint8_t kNoFilter = 0;  // pieces are flat: repeats are found without one

  static std::uint8_t rounded(float value) {
    return static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
  }

  std::size_t width_, height_;
  std::uint8_t grout_[3];
  std::vector<std::uint8_t> covered_;  // how much of each pixel pieces cover, of 255
  std::vector<std::uint8_t> scanlines_;
};

// Where else on a seamless sheet an outline shows that sticks out of it.
std::vector<Polygon> copies_across(const PieceSheet& sheet, const Polygon& outline) {
  Point least = outline.outer.front(), most = least;
  for (const Point p : outline.outer) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
  // Shifted by so many sheets, [from, to], it meets the sheet.
  const auto from = [](double end, double size) { return static_cast<int>(std::ceil(-end / size)); };
  const auto to = [](double begin, double size) { return static_cast<int>(std::floor((size - begin) / size)); };
  std::vector<Polygon> copies;
  for (int j = from(most.y, sheet.height); j <= to(least.y, sheet.height); ++j)
    for (int i = from(most.x, sheet.width); i <= to(least.x, sheet.width); ++i) {
      if (i == 0 && j == 0) continue;
      copies.push_back(outline);
      const Point way{i * sheet.width, j * sheet.height};
      for (Point& p : copies.back().outer) p += way;
      for (Ring& hole : copies.back().holes)
        for (Point& p : hole) p += way;
    }
  return copies;
}

Picture draw(const PieceSheet& sheet, double scale, int width, int height) {
  Picture picture(width, height, sheet.grout);
  Coverage coverage(width, height);
  for (const Piece& piece : sheet.pieces) {
    const auto paint = [&](int x, int y, float share) { picture.paint(x, y, piece.fill, share); };
    coverage.each_pixel(piece.outline, scale, paint);
    if (!sheet.seamless) continue;
    for (const Polygon& copy : copies_across(sheet, piece.outline)) coverage.each_pixel(copy, scale, paint);
  }
  return picture;
}

Picture draw(const PieceSheet& sheet, double scale) {
  const auto pixels = [scale](double length) { return std::max(1, static_cast<int>(std::lround(length * scale))); };
  return draw(sheet, scale, pixels(sheet.width), pixels(sheet.height));
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

void append_header(std::string& out, std::size_t width, std::size_t height, int bits, int channels) {
  std::string data;
  append_u32(data, width);
  append_u32(data, height);
  data += static_cast<char>(bits);
  data += channels == 1 ? '\0' : '\x02';        // grey or RGB
  data += std::string_view("\x00\x00\x00", 3);  // deflate, filter a line, not interlaced
  append_chunk(out, "IHDR", data);
}

void append_header(std::string& out, const Picture& picture) {
  append_header(out, picture.width(), picture.height(), 8, 3);
}

void append_resolution(std::string& out, double pixels_per_metre) {
  std::string data;
  const auto resolution = static_cast<std::uint64_t>(std::clamp(pixels_per_metre + 0.5, 1.0, 2e9));
  append_u32(data, resolution);
  append_u32(data, resolution);
  data += '\x01';  // a metre
  append_chunk(out, "pHYs", data);
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

template <class Part>
void compress(const Picture& picture, const Part& part) {
  compress(
      picture.height(), picture.stride(), [&](std::size_t y) { return picture.scanline(y); }, part);
}

void append_pixels(std::string& out, const Picture& picture) {
  compress(picture, [&](std::string_view part) { append_chunk(out, "IDAT", part); });
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
  const Picture picture = draw(sheet, scale);
  std::string out(kSignature);
  append_header(out, picture);
  if (sheet.width_mm > 0) append_resolution(out, 1000 * scale * sheet.width / sheet.width_mm);
  append_pixels(out, picture);
  append_chunk(out, "IEND", {});
  return out;
}

std::string write_png(const Raster& raster) {
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
  append_header(out, static_cast<std::size_t>(raster.width), height, raster.bits, raster.channels);
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

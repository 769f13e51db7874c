// Small files of every kind, made by the tests themselves.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera {

using FileBytes = std::vector<std::uint8_t>;

// What a decoded picture must look like: 3 bytes a pixel.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

struct PngChunk {
  std::string type;
  FileBytes data;
};

inline void append_big_endian(FileBytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

inline void append_chunk(FileBytes& out, const PngChunk& chunk) {
  append_big_endian(out, static_cast<std::uint32_t>(chunk.data.size()));
  const std::size_t start = out.size();
  out.insert(out.end(), chunk.type.begin(), chunk.type.end());
  out.insert(out.end(), chunk.data.begin(), chunk.data.end());
  append_big_endian(out,
                    static_cast<std::uint32_t>(crc32(0, out.data() + start, static_cast<uInt>(out.size() - start))));
}

inline FileBytes deflated(const FileBytes& plain) {
  uLongf size = compressBound(plain.size());
  FileBytes packed(size);
  compress(packed.data(), &size, plain.data(), plain.size());
  packed.resize(size);
  return packed;
}

// Every pixel has a colour of its own.
inline Pixels colourful(int width, int height) {
  Pixels pixels{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      pixels.rgb.push_back(static_cast<std::uint8_t>(37 * x + 11));
      pixels.rgb.push_back(static_cast<std::uint8_t>(59 * y + 7));
      pixels.rgb.push_back(static_cast<std::uint8_t>(5 * x + 3 * y));
    }
  }
  return pixels;
}

enum class PngColour : std::uint8_t { kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6 };

// A PNG by the letter of its specification. `rows` are the packed bytes of all rows without filter bytes; `extra`
// comes between header and pixels.
inline FileBytes png_file(std::uint32_t width, std::uint32_t height, int bit_depth, PngColour colour,
                          const FileBytes& rows, const std::vector<PngChunk>& extra = {}) {
  FileBytes file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  FileBytes header;
  append_big_endian(header, width);
  append_big_endian(header, height);
  header.insert(header.end(), {static_cast<std::uint8_t>(bit_depth), static_cast<std::uint8_t>(colour), 0, 0, 0});
  append_chunk(file, {"IHDR", header});
  for (const PngChunk& chunk : extra) append_chunk(file, chunk);

  FileBytes filtered;
  const std::size_t stride = height == 0 ? 0 : rows.size() / height;
  for (std::size_t y = 0; y < height && stride > 0; ++y) {
    filtered.push_back(0);
    filtered.insert(filtered.end(), rows.begin() + static_cast<std::ptrdiff_t>(y * stride),
                    rows.begin() + static_cast<std::ptrdiff_t>((y + 1) * stride));
  }
  append_chunk(file, {"IDAT", deflated(filtered)});
  append_chunk(file, {"IEND", {}});
  return file;
}

inline FileBytes png_file(const Pixels& pixels, const std::vector<PngChunk>& extra = {}) {
  return png_file(static_cast<std::uint32_t>(pixels.width), static_cast<std::uint32_t>(pixels.height), 8,
                  PngColour::kRgb, pixels.rgb, extra);
}

// An EXIF block that says no more than an orientation.
inline FileBytes exif_block(int orientation, bool big_endian) {
  const auto value = static_cast<std::uint8_t>(orientation);
  if (big_endian) {
    return {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 0x01, 0x12, 0, 3, 0, 0, 0, 1, 0, value, 0, 0, 0, 0, 0, 0};
  }
  return {'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 0x12, 0x01, 3, 0, 1, 0, 0, 0, value, 0, 0, 0, 0, 0, 0, 0};
}

}  // namespace tessera

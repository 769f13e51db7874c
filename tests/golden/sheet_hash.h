// A sheet in one number: whoever changes its geometry shall know it.
#pragma once

#include <cmath>
#include <cstdint>

#include "tessera/geometry/piece.h"

namespace tessera {

// FNV-1a, 64 bits.
class Hash {
 public:
  void add(std::int64_t value) {
    for (int i = 0; i < 8; ++i) {
      hash_ ^= static_cast<std::uint64_t>(value) >> (8 * i) & 255;
      hash_ *= 0x100000001b3;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

// Colours, and vertices rounded to hundredths of a pixel.
inline std::uint64_t hash_of(const PieceSheet& sheet) {
  Hash hash;
  for (const Piece& piece : sheet.pieces) {
    hash.add(piece.fill.r << 16 | piece.fill.g << 8 | piece.fill.b);
    hash.add(static_cast<std::int64_t>(piece.outline.outer.size()));
    for (const Point p : piece.outline.outer) {
      hash.add(std::llround(p.x * 100));
      hash.add(std::llround(p.y * 100));
    }
  }
  return hash.value();
}

}  // namespace tessera

// Whole numbers in files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tessera {

enum class ByteOrder { kLittle, kBig };

// The whole number in `size` (up to 4) bytes at `offset`; 0 where they lie beyond the end.
inline std::uint32_t read_number(std::span<const std::uint8_t> bytes, std::size_t offset, std::size_t size,
                                 ByteOrder order) {
  if (offset > bytes.size() || size > bytes.size() - offset) return 0;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8 | bytes[offset + (order == ByteOrder::kBig ? i : size - 1 - i)];
  }
  return value;
}

}  // namespace tessera

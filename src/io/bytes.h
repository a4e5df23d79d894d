// Numbers as bytes, in a named order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/doubles.h"

namespace dymsum::io {

template <class T>
using BitsOf = std::conditional_t<sizeof(T) == 1, std::uint8_t,
                                  std::conditional_t<sizeof(T) == 2, std::uint16_t,
                                                     std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

/// The number whose bytes stand at `offset`. Requires offset + sizeof(T) <= bytes.size().
template <class T>
T from_bytes(std::string_view bytes, std::size_t offset, std::endian order) {
  BitsOf<T> bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t from = order == std::endian::little ? sizeof(T) - 1 - i : i;
    const auto byte = static_cast<unsigned char>(bytes[offset + from]);
    bits = static_cast<BitsOf<T>>((static_cast<std::uint64_t>(bits) << 8) | byte);
  }
  return base::bit_cast<T>(bits);
}

/// Appends the bytes of a number, the lowest first.
template <class T>
void append_bytes(std::string& out, T value) {
  auto bits = static_cast<std::uint64_t>(base::bit_cast<BitsOf<T>>(value));
  for (std::size_t i = 0; i < sizeof(T); ++i, bits >>= 8) out += static_cast<char>(bits & 0xff);
}

}  // namespace dymsum::io

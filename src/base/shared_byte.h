// Bytes of an array that several threads read and write, in no order: std::atomic_ref, which the standard library of
// Debian 12's emscripten lacks.
#pragma once

#include <cstdint>

namespace dymsum::base {

inline std::uint8_t shared_byte(const std::uint8_t& byte) { return __atomic_load_n(&byte, __ATOMIC_RELAXED); }
inline void set_shared_byte(std::uint8_t& byte, std::uint8_t value) {
  __atomic_store_n(&byte, value, __ATOMIC_RELAXED);
}

}  // namespace dymsum::base

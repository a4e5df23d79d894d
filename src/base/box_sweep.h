// The pairs of many boxes that meet: in the order of their left sides, eight at a time.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include "base/scratch.h"

namespace dymsum {

// Boxes in 15-bit numbers, compared eight at a time, in the order of their left sides.

/// Sides of boxes are below this.
inline constexpr int kBoxQuanta = 0x7fff;

/// Eight numbers; comparing gives -1 or 0 in each. In memory the first one comes first, and so in a word read from
/// there its low bits.
static_assert(std::endian::native == std::endian::little);
using Lanes = std::int16_t __attribute__((vector_size(16)));
inline constexpr std::uint32_t kLanes = 8;

inline Lanes load_lanes(const std::int16_t* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

/// One bit for each lane that is zero; lane_of gives the lane of the lowest one.
#if defined(__SSE2__) || defined(__wasm_simd128__)
inline std::uint32_t zero_lanes(const Lanes& lanes) {
#ifdef __SSE2__
  return ~static_cast<std::uint32_t>(_mm_movemask_epi8(reinterpret_cast<__m128i>(lanes))) & 0x5555;
#else
  return ~static_cast<std::uint32_t>(wasm_i8x16_bitmask(reinterpret_cast<v128_t>(lanes))) & 0x5555;
#endif
}
inline std::uint32_t lane_of(std::uint32_t bits) { return static_cast<std::uint32_t>(std::countr_zero(bits)) / 2; }
#else
inline std::uint64_t zero_lanes(const Lanes& lanes) {
  std::array<std::uint64_t, 2> halves;
  std::memcpy(&halves, &lanes, sizeof halves);
  return (~halves[0] & 0x0001000100010001) | (~halves[1] & 0x0002000200020002);
}
inline std::uint32_t lane_of(std::uint64_t bits) {
  const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
  return bit / 16 + 4 * (bit & 1);
}
#endif

/// Sixteen numbers of a coarser grid, from -128 up to 126; kBeyond is greater than all.
using ByteLanes = std::int8_t __attribute__((vector_size(16)));
inline constexpr std::uint32_t kByteLanes = 16;
inline constexpr std::int8_t kBeyond = 127;

/// Monotone in the finer quantum.
inline std::int8_t byte_quantum(std::int16_t quantum) {
  const auto coarse = static_cast<std::int16_t>(quantum >> 7);
  return static_cast<std::int8_t>(std::min<std::int16_t>(coarse, 254) - 128);
}

inline ByteLanes load_bytes(const std::int8_t* from) {
  ByteLanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline ByteLanes all_bytes(std::int8_t v) { return ByteLanes{} + v; }

/// The left side of a box above its number.
inline std::uint64_t left_order(std::int16_t left, std::uint32_t number) {
  return static_cast<std::uint64_t>(left) << 32 | number;
}

/// Ascending: by buckets first where they are many, then by insertion.
template <class Allocator>
void sort_by_left(std::vector<std::uint64_t, Allocator>& order) {
  const std::size_t n = order.size();
  if (n > 24) {
    const int shift = 32 + 15 - std::min(15, static_cast<int>(std::bit_width(n)));
    using Counts =
        std::vector<std::uint32_t, typename std::allocator_traits<Allocator>::template rebind_alloc<std::uint32_t>>;
    Counts start((std::uint64_t{kBoxQuanta} << 32 >> shift) + 2, 0, order.get_allocator());
    for (const std::uint64_t o : order) ++start[(o >> shift) + 1];
    for (std::size_t b = 1; b < start.size(); ++b) start[b] += start[b - 1];
    std::vector<std::uint64_t, Allocator> sorted(n, order.get_allocator());
    for (const std::uint64_t o : order) sorted[start[o >> shift]++] = o;
    order.swap(sorted);
  }
  for (std::size_t k = 1; k < n; ++k) {
    const std::uint64_t o = order[k];
    std::size_t at = k;
    for (; at > 0 && order[at - 1] > o; --at) order[at] = order[at - 1];
    order[at] = o;
  }
}

/// A box in quanta below kBoxQuanta.
struct BoxQuanta {
  std::int16_t x0, y0, x1, y1;
};

/// Goes through every box k in the order of their left sides: first requests wanted = wanted_by(k, i), k being the
/// i-th; then calls meet(k, others) with those that start no earlier, meet it and are wanted(other). Returns how many
/// pairs were compared.
template <class WantedBy, class Meet>
std::uint64_t sweep_boxes(std::span<const BoxQuanta> boxes, Scratch* memory, WantedBy&& wanted_by, Meet&& meet) {
  const auto n = static_cast<std::uint32_t>(boxes.size());
  Array<std::uint64_t> order(n, memory);
  for (std::uint32_t k = 0; k < n; ++k) order[k] = left_order(boxes[k].x0, k);
  sort_by_left(order);
  // After the last box lie some that start to the right of everything and meet nothing.
  const std::size_t padded = std::size_t{n} + 2 * kLanes;
  Array<std::int16_t> sides(3 * padded, memory);
  std::int16_t *x0 = sides.data(), *y0 = x0 + padded, *y1 = y0 + padded;
  for (std::uint32_t k = 0; k < n; ++k) {
    const BoxQuanta& b = boxes[order[k] & 0xffffffff];
    x0[k] = b.x0;
    y0[k] = b.y0;
    y1[k] = b.y1;
  }
  for (std::size_t k = n; k < padded; ++k) {
    x0[k] = y0[k] = std::numeric_limits<std::int16_t>::max();
    y1[k] = -1;
  }
  Array<std::uint32_t> near(std::size_t{n} + 1, memory);
  std::uint64_t compared = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::uint32_t>(order[i]);
    const auto wanted = wanted_by(k, i);
    const std::int16_t right = boxes[k].x1;
    const Lanes low = Lanes{} + y0[i], high = Lanes{} + y1[i];
    std::uint32_t* hit = near.data();
    std::uint32_t j = i + 1;
    for (; x0[j] <= right; j += kLanes) {
      const Lanes apart = (load_lanes(y0 + j) > high) | (low > load_lanes(y1 + j));
      for (auto hits = zero_lanes(apart); hits != 0; hits &= hits - 1) {
        const auto other = static_cast<std::uint32_t>(order[j + lane_of(hits)]);
        *hit = other;
        hit += static_cast<std::uint32_t>(wanted(other));
      }
    }
    compared += j - i - 1;
    meet(k, std::span<const std::uint32_t>(near.data(), hit));
  }
  return compared;
}

}  // namespace dymsum

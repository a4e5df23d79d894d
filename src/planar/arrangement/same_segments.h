// Segments that a convolution holds twice.
#pragma once

#include <bit>
#include <cstdint>

#include "base/bit_cast.h"
#include "planar/arrangement/soup.h"

namespace dymsum::planar {

/// Segments by their ends. Sums of operands with common edge vectors, above all P + P, hold most segments twice; one is
/// enough.
class SameSegments {
 public:
  explicit SameSegments(const Soup& soup) : soup_(soup), slots_(soup.memory) {}
  void reserve(std::size_t n) {
    slots_.assign(std::bit_ceil(2 * n + 1), kNone);
    shift_ = 64 - std::countr_zero(slots_.size());
  }

  // The earlier segment with exactly the same ends, or kNone; then s is remembered.
  std::uint32_t find_or_add(std::uint32_t s) {
    const SoupBox& b = soup_.boxes[s];
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash(b) >> shift_;
    for (; slots_[at] != kNone; at = (at + 1) & mask) {
      const std::uint32_t t = slots_[at];
      const SoupBox& c = soup_.boxes[t];
      if (b.ax == c.ax && b.ay == c.ay && b.bx == c.bx && b.by == c.by &&
          (soup_.exact_sums() || (soup_.lattice.same(soup_.exact(soup_.start(s)), soup_.exact(soup_.start(t))) &&
                                  soup_.lattice.same(soup_.exact(soup_.end(s)), soup_.exact(soup_.end(t))))))
        return t;
    }
    slots_[at] = s;
    return kNone;
  }

 private:
  // Its high bits count: doubles that hold small integers end in zeros.
  static std::uint64_t hash(const SoupBox& b) {
    const auto bits = [](double v) { return base::bit_cast<std::uint64_t>(v); };
    return bits(b.ax) * 0x9e3779b97f4a7c15 + bits(b.ay) * 0xc2b2ae3d27d4eb4f + bits(b.bx) * 0x165667b19e3779f9 +
           bits(b.by) * 0x27d4eb2f165667c5;
  }
  const Soup& soup_;
  Array<std::uint32_t> slots_;
  int shift_ = 0;
};

}  // namespace dymsum::planar

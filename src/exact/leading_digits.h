// An integer of a fixed width as an interval of two doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "exact/int.h"
#include "exact/interval.h"

namespace dymsum::exact {

/// Contains v 2^shift: a point where v has at most 106 binary digits, else within 2^-105 of the size of v 2^shift.
/// Below 2^-790 it is an interval about 0. Requires |v 2^shift| < 2^299. No integer of any size is made. O(limbs).
template <int B>
requires(B > 126) FineInterval leading_digits(const Int<B>& v, int shift) {
  const auto size = abs(v).raw();
  int bits = 64 * static_cast<int>(size.w.size());
  while (bits > 0 && ((size.w[static_cast<std::size_t>(bits - 1) / 64] >> ((bits - 1) % 64)) & 1) == 0) --bits;
  if (bits == 0) return {};
  // No smaller radius: what intervals are multiplied by stays far from the least doubles.
  const auto up_to = [](int exponent) {
    const double r = std::ldexp(1.0, std::max(exponent, -900));
    return FineInterval(Interval(-r, r));
  };
  if (bits + shift < -790) return up_to(bits + shift);
  // The digits from `first` to before `last`, at most 53, where they stand.
  const auto digits = [&](int first, int last) {
    const auto word = static_cast<std::size_t>(first / 64);
    const int offset = first % 64;
    std::uint64_t all = size.w[word] >> offset;
    if (offset > 0 && word + 1 < size.w.size()) all |= size.w[word + 1] << (64 - offset);
    all &= (std::uint64_t{1} << (last - first)) - 1;
    return std::ldexp(static_cast<double>(all) * (sign(v) < 0 ? -1 : 1), first + shift);
  };
  const int second = std::max(0, bits - 53), rest = std::max(0, bits - 106);
  if (second == 0) return FineInterval(digits(0, bits));
  const FineInterval both = FineInterval::difference(-digits(rest, second), digits(second, bits));
  return rest == 0 ? both : both + up_to(rest + shift);
}

}  // namespace dymsum::exact

#include "exact/wide_interval.h"

namespace dymsum::exact {

WideInterval WideInterval::of(double v) {
  if (!(std::abs(v) < 0x1p60)) return whole();
  // The parts of v in each word, the largest first; every difference is exact.
  WideInterval r;
  double rest = std::abs(v), unit = 1;
  for (int k = 4; k >= 0; --k, unit *= 0x1p-64) {
    const double part = std::floor(rest / unit);
    r.midpoint_.w[static_cast<std::size_t>(k)] = static_cast<std::uint64_t>(part);
    rest -= part * unit;
  }
  if (v < 0) r.midpoint_ = limbs_sub(Midpoint{}, r.midpoint_);
  r.radius_ = rest > 0 ? kUnit : 0;
  return r;
}

WideInterval WideInterval::around(const BigInteger& value, const BigInteger& error, long shift) {
  const long by = shift + kFractionBits;
  BigInteger units = abs(value);
  bool cut = false;
  if (by >= 0) {
    // Beyond this many bits it is too large, whatever its digits.
    if (!units.is_zero() && static_cast<long>(msb(units)) + by > 62 + kFractionBits) return whole();
    units <<= by;
  } else {
    const auto down = static_cast<unsigned long>(-by);
    cut = !units.is_zero() && lsb(units) < down;
    units >>= down;
  }
  WideInterval r;
  for (std::uint64_t& word : r.midpoint_.w) {
    word = static_cast<std::uint64_t>(units & BigInteger(~std::uint64_t{0}));
    units >>= 64;
  }
  if (!units.is_zero() || r.midpoint_.w[4] > kMost) return whole();
  if (value.sign() < 0) r.midpoint_ = limbs_sub(Midpoint{}, r.midpoint_);
  double radius = cut ? kUnit : 0;
  if (!error.is_zero()) {
    // error < 2^bits.
    const long bits = static_cast<long>(msb(error)) + 1 + shift;
    if (bits > 60) return whole();
    radius += bits < -kFractionBits ? kUnit : std::ldexp(1.0, static_cast<int>(bits));
  }
  return {r.midpoint_, radius * kOutwards};
}

}  // namespace dymsum::exact

// Functions of the angle in a window, to first order, in doubles with a bound of everything left out: candidates are
// told from what never happens in the window by these.
#pragma once

#include <cmath>

namespace dymsum::spatial {

/// For every u in [-1, 1], that is every angle of a window, the function is within `rest` of value + slope u.
struct Jet {
  double value = 0, slope = 0, rest = 0;

  double reach() const { return (std::abs(slope) + rest) * (1 + 0x1p-40); }
  double low() const { return value - reach(); }
  double high() const { return value + reach(); }
  /// Its sign throughout, or 0 where that is not certain.
  int sign() const { return value > reach() ? 1 : value < -reach() ? -1 : 0; }
};

// Every operation rounds value and slope by 2^-53 of the terms, twice at most, and products of tiny numbers by less
// than 2^-1000; the bounds themselves are rounded by less than what they are raised by.
inline Jet operator+(Jet a, Jet b) {
  const double value = a.value + b.value, slope = a.slope + b.slope;
  return {value, slope, (a.rest + b.rest) * (1 + 0x1p-50) + (std::abs(value) + std::abs(slope)) * 0x1p-52};
}
inline Jet operator-(Jet a) { return {-a.value, -a.slope, a.rest}; }
inline Jet operator-(Jet a, Jet b) { return a + -b; }
inline Jet operator*(Jet a, Jet b) {
  const double va = std::abs(a.value), vb = std::abs(b.value), sa = std::abs(a.slope), sb = std::abs(b.slope);
  const double rest = va * b.rest + vb * a.rest + a.rest * b.rest + sa * (sb + b.rest) + a.rest * sb;
  const double rounded = (va * vb + va * sb + vb * sa) * 0x1p-51 + 0x1p-1000;
  return {a.value * b.value, a.value * b.slope + b.value * a.slope, rest * (1 + 0x1p-48) + rounded};
}

}  // namespace dymsum::spatial

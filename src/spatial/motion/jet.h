// Functions of the angle in a window, to first order, in doubles with a bound of everything left out: candidates are
// told from what never happens in the window by these.
#pragma once

#include <cmath>

#include "base/doubles.h"

namespace dymsum::spatial {

/// A function of u that is within `rest` of value + slope u for every u in [-1, 1], that is every angle of a window.
struct Jet {
  double value = 0, slope = 0, rest = 0;

  double reach() const { return (std::abs(slope) + rest) * (1 + 0x1p-40); }
  double low() const { return value - reach(); }
  double high() const { return value + reach(); }
  /// Its sign throughout, or 0 where that is not proved.
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

/// The same with some thirty digits of the value, for windows as narrow as 1e-16: what nearly vanishes there is
/// determined by its value. Magnitudes are at most 2^100.
struct FineJet {
  base::DoublePair value;
  double slope = 0, rest = 0;

  static FineJet of(double v) { return {{v, 0}, 0, 0}; }
  /// b - a exactly.
  static FineJet difference(double a, double b) { return {base::exact_sum(b, -a), 0, 0}; }
  double size() const { return std::abs(value.high) * (1 + 0x1p-50); }  ///< at least |value|
  double reach() const { return (std::abs(slope) + rest) * (1 + 0x1p-40); }
  /// The sign, as that of a Jet.
  int sign() const {
    const double least = std::abs(value.high) * (1 - 0x1p-50);
    return !(least > reach()) ? 0 : value.high > 0 ? 1 : -1;
  }
};

// Values are rounded by less than kPairError of themselves, and by 2^-900 where error terms underflow; slopes as those
// of jets, with the value's second half left out.
inline FineJet operator+(const FineJet& a, const FineJet& b) {
  const base::DoublePair value = a.value + b.value;
  const double slope = a.slope + b.slope;
  return {
      value, slope,
      (a.rest + b.rest) * (1 + 0x1p-50) + std::abs(value.high) * (2 * base::kPairError) + std::abs(slope) * 0x1p-52};
}
inline FineJet operator-(const FineJet& a) { return {-a.value, -a.slope, a.rest}; }
inline FineJet operator-(const FineJet& a, const FineJet& b) { return a + -b; }
inline FineJet operator*(const FineJet& a, const FineJet& b) {
  const double va = a.size(), vb = b.size(), sa = std::abs(a.slope), sb = std::abs(b.slope);
  const double rest = va * b.rest + vb * a.rest + a.rest * b.rest + sa * (sb + b.rest) + a.rest * sb;
  const double rounded = va * vb * (2 * base::kPairError) + (va * sb + vb * sa) * 0x1p-51 + 0x1p-900;
  return {a.value * b.value, a.value.high * b.slope + b.value.high * a.slope, rest * (1 + 0x1p-48) + rounded};
}

}  // namespace dymsum::spatial

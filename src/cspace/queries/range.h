// Intervals of numbers and of points. Roundings are not in them: who uses them adds a margin.
#pragma once

#include <algorithm>
#include <cmath>

#include "dymsum/region.h"

namespace dymsum::cspace {

/// All values between low and high.
struct Range {
  double low = 0, high = 0;
};
inline Range operator+(Range a, Range b) { return {a.low + b.low, a.high + b.high}; }
inline Range operator-(Range a, Range b) { return {a.low - b.high, a.high - b.low}; }
inline Range operator*(double a, Range b) {
  return a >= 0 ? Range{a * b.low, a * b.high} : Range{a * b.high, a * b.low};
}
inline Range operator*(Range a, Range b) {
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}
inline Range operator+(double a, Range b) { return {a + b.low, a + b.high}; }
inline Range join(Range a, Range b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }
inline Range clamp(Range a, double low, double high) {
  return {std::clamp(a.low, low, high), std::clamp(a.high, low, high)};
}
inline Range between(double a, double b) { return {std::min(a, b), std::max(a, b)}; }
/// The square of the number nearest to 0.
inline double least_square(Range a) { return a.low > 0 ? a.low * a.low : a.high < 0 ? a.high * a.high : 0; }
inline double magnitude(Range a) { return std::max(std::abs(a.low), std::abs(a.high)); }

struct PointRange {
  Range x, y;
};
inline PointRange operator+(const PointRange& a, const PointRange& b) { return {a.x + b.x, a.y + b.y}; }
inline PointRange operator-(const PointRange& a, const PointRange& b) { return {a.x - b.x, a.y - b.y}; }
inline PointRange operator*(Range a, const PointRange& b) { return {a * b.x, a * b.y}; }
inline Range cross(const PointRange& a, const PointRange& b) { return a.x * b.y - a.y * b.x; }
inline Range dot(const PointRange& a, const PointRange& b) { return a.x * b.x + a.y * b.y; }

/// A vector that turns by an angle of at most `half` either way; requires half <= 1.
inline PointRange turning(Point v, double half) {
  const Range c{1 - half * half / 2, 1}, s{-half, half};
  return {v.x * c + -v.y * s, v.y * c + v.x * s};
}

}  // namespace dymsum::cspace

// Exact signs of 2x2 determinants and scalar products of plain doubles of any exponents: a floating-point filter with a
// proved error bound answers almost always; what it leaves open is computed in integers on the common grid of the
// arguments.
#pragma once

#include <cstdint>

#include "dymsum/region.h"

namespace dymsum::exact {

/// Who answered: the filter, or exact integers with coordinates of at most 2^61, 2^125, or any size.
enum class Rung { filter, int61, int125, big };

struct SignAnswer {
  int sign = 0;  ///< -1, 0, 1
  Rung rung = Rung::filter;
};

/// A running tally of who answered.
struct FilterCounts {
  std::uint64_t filtered = 0, exact = 0;

  int add(SignAnswer answer) {
    ++(answer.rung == Rung::filter ? filtered : exact);
    return answer.sign;
  }
  friend bool operator==(const FilterCounts&, const FilterCounts&) = default;
};

/// The sign of (b - a) x (d - c), exactly. Requires finite coordinates.
SignAnswer cross_answer(Point a, Point b, Point c, Point d);
/// The sign of (b - a) . (d - c), exactly. Requires finite coordinates.
SignAnswer dot_answer(Point a, Point b, Point c, Point d);

/// The sign of (b - a) x (d - c): > 0 when direction cd points to the left of direction ab.
inline int cross_sign(Point a, Point b, Point c, Point d) { return cross_answer(a, b, c, d).sign; }
inline int cross_sign(Point a, Point b, Point c, Point d, FilterCounts& counts) {
  return counts.add(cross_answer(a, b, c, d));
}

/// The sign of (b - a) . (d - c).
inline int dot_sign(Point a, Point b, Point c, Point d) { return dot_answer(a, b, c, d).sign; }
inline int dot_sign(Point a, Point b, Point c, Point d, FilterCounts& counts) {
  return counts.add(dot_answer(a, b, c, d));
}

/// The sign of (b - a) x (c - a): > 0 when a, b, c turn counter-clockwise, 0 when they are collinear.
inline int orient_sign(Point a, Point b, Point c) { return cross_sign(a, b, a, c); }
inline int orient_sign(Point a, Point b, Point c, FilterCounts& counts) { return cross_sign(a, b, a, c, counts); }

}  // namespace dymsum::exact

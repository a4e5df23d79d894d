// Signs of small polynomials over exact integers, generic in the number type (Int of any widths, mixed, or Big). Exact
// by construction: the intermediate types are as wide as the values can be.
#pragma once

#include "exact/int.h"

namespace dymsum::exact {

/// sign(ax by - ay bx): > 0 when b points to the left of a.
template <class Ax, class Ay, class Bx, class By>
constexpr int sign_of_cross(const Ax& ax, const Ay& ay, const Bx& bx, const By& by) {
  return sign(ax * by - ay * bx);
}

/// sign(ax bx + ay by).
template <class Ax, class Ay, class Bx, class By>
constexpr int sign_of_dot(const Ax& ax, const Ay& ay, const Bx& bx, const By& by) {
  return sign(ax * bx + ay * by);
}

/// sign(n1 / d1 - n2 / d2) for d1, d2 != 0 of any sign.
template <class N1, class D1, class N2, class D2>
constexpr int compare_ratios(const N1& n1, const D1& d1, const N2& n2, const D2& d2) {
  return sign(n1 * d2 - n2 * d1) * sign(d1) * sign(d2);
}

/// -1, 0, 1 for a < b, a == b, a > b, without widening.
template <class A, class B>
constexpr int compare(const A& a, const B& b) {
  return (a > b) - (a < b);
}

}  // namespace dymsum::exact

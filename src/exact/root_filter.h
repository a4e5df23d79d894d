// Simple real roots of polynomials in doubles with proved error bounds: answers for generic polynomials, never a wrong
// one.
#pragma once

#include <optional>
#include <vector>

#include "exact/polynomial.h"

namespace dymsum::exact {

/// low < x < high contains exactly one root of a polynomial, a simple one, and the polynomial is not zero at the ends.
struct DoubleBracket {
  double low = 0, high = 0;
};

/// The sign that p has at all points of [low, high], if there is one and doubles decide.
std::optional<int> filtered_sign(const Polynomial& p, double low, double high);

/// All roots of p in (lo, hi), ascending, when doubles prove that they are simple and that lo and hi are none; nothing
/// where they do not. The brackets are as narrow as signs in doubles can make them, some dozens of units in the last
/// place where roots are well apart. Requires lo < hi. Descartes' rule on halved intervals, then Newton's iteration.
std::optional<std::vector<DoubleBracket>> filtered_roots(const Polynomial& p, double lo, double hi);

}  // namespace dymsum::exact

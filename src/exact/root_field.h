// Whether an expression with square roots is zero, by algebra: as polynomials in roots, without a bound that has to be
// reached.
//
// Every part is N / D with D > 0, and N, D polynomials with integer coefficients in roots g1, g2, ... in which no root
// has a power: a tower of extensions g^2 = R, R made of earlier roots. Roots of integers come as a basis: a new one is
// a rational multiple of a product of others, or is independent of them. Then its products are linearly independent
// over the rationals (Besicovitch 1940), and a polynomial in these roots alone is zero only if it has no term.
// With a nested root on top, N = X + Y g: if neither X nor Y is zero, N = 0 exactly if X^2 - Y^2 R = 0 and the signs of
// X and Y differ; these are found with growing precision, which ends as they are not zero.
#pragma once

#include <optional>

#include "exact/root_expression.h"

namespace dymsum::exact {

/// Whether the number is 0; nothing where there are too many roots or terms. Exact. Some multiplications of integers
/// for sums of roots of integers; for each nested root that the other roots do not make superfluous, polynomials and
/// coefficients are twice as long.
std::optional<bool> is_zero_by_algebra(const RootParts& parts);

}  // namespace dymsum::exact

// A position of the plane as a fraction.
#pragma once

#include "exact/big.h"

namespace dymsum::exact {

/// (x / w, y / w), w > 0, not necessarily in lowest terms.
struct HomogeneousPoint {
  BigInteger x, y, w;
};

/// The same position without a common factor; without common factors of two.
HomogeneousPoint in_lowest_terms(HomogeneousPoint p);
HomogeneousPoint without_twos(HomogeneousPoint p);
/// That of a finite double point.
HomogeneousPoint homogeneous(double x, double y);

}  // namespace dymsum::exact

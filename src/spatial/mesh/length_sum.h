// Sums of lengths of exact vectors, rounded once: areas of surfaces.
#pragma once

#include <string>
#include <vector>

#include "exact/big.h"
#include "exact/vector3.h"

namespace dymsum::spatial {

/// The sum of the lengths of some vectors, times a positive unit.
struct LengthSum {
  std::vector<exact::Vector3<exact::Big>> vectors;
  exact::BigRational unit = 1;

  /// The nearest double. Doubles of double length nearly always decide; where they do not, whole roots of ever more
  /// digits do. That ends: positive roots of rationals have a rational sum only where each of them is rational, which
  /// whole roots show, and any other number has a distance from every position where its rounding changes.
  double nearest() const;
  /// 17 digits, correctly rounded.
  std::string text() const;
};

}  // namespace dymsum::spatial

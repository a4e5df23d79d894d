// Scales that are computed, where only those within the range of Scale can be gone to.
#pragma once

#include "dymsum/scale.h"
#include "exact/big.h"

namespace dymsum::spatial {

/// Thrown where an answer takes a sum at a scale that is none of Scale.
struct BeyondScales {
  Error error;
};

/// Throws BeyondScales.
inline Scale computed_scale(const exact::BigRational& s) {
  Result<Scale> scale = Scale::of(exact::to_rational(s));
  if (!scale) throw BeyondScales{scale.error()};
  return *std::move(scale);
}

/// Calls make(), which returns a Result, and reports what it throws as its error.
template <class F>
auto within_scales(F make) -> decltype(make()) {
  try {
    return make();
  } catch (const BeyondScales& beyond) {
    return beyond.error;
  }
}

}  // namespace dymsum::spatial

// Single precision, as doubles.
#pragma once

namespace dymsum::base {

/// The nearest number of single precision, infinite past its range. The step through memory is there for GCC 12: with
/// -O3 it leaves out the conversion to single precision and back where it takes two coordinates at a time.
inline double in_single(double value) {
  const volatile float nearest = static_cast<float>(value);
  return nearest;
}

}  // namespace dymsum::base

// The unit in which a part is measured that is far smaller or larger than what it has to fit.
#pragma once

#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "dymsum/rational.h"
#include "exact/big.h"

namespace dymsum {

/// k so that 2^-k times a part is about as large as what it has to fit, whose sizes these are. Scales of the part are
/// 2^-k times those of that one, which are moderate. 0 where they are so already: within 2^+-40, far from the ends of
/// Scale.
inline int part_unit(double part_size, double other_size) {
  if (!(part_size > 0 && other_size > 0 && std::isfinite(part_size) && std::isfinite(other_size))) return 0;
  const int k = std::ilogb(part_size) - std::ilogb(other_size);
  return std::abs(k) <= 40 ? 0 : k;
}

/// 2^-k v where that is a double.
inline std::optional<double> in_unit(double v, int k) {
  const double made = std::scalbn(v, -k);
  if (!std::isfinite(made) || std::scalbn(made, k) != v) return std::nullopt;
  return made;
}

/// Makes scales of the part of scales of the part in its unit.
template <class Range>
Range in_input_units(Range range, int k) {
  const exact::BigInteger power = exact::BigInteger(1) << static_cast<unsigned>(std::abs(k));
  const auto back = [&](std::optional<Rational>& s) {
    if (!s) return;
    const exact::BigRational v = exact::exact_value(*s);
    s = exact::to_rational(k < 0 ? exact::BigRational(v * power) : exact::BigRational(v / power));
  };
  for (auto& interval : range.free) {
    back(interval.low);
    back(interval.high);
  }
  return range;
}

}  // namespace dymsum

#include "spatial/mesh/fine_coordinate.h"

#include <algorithm>
#include <cmath>

#include "exact/binary_parts.h"

namespace dymsum::spatial {

exact::FineInterval fine_coordinate(const exact::Big& v, int shift) {
  using exact::Big;
  using exact::FineInterval;
  const exact::BinaryParts high = exact::binary_parts(v);
  if (high.is_zero()) return {};
  // Below this, and for what is left behind two doubles, an interval about 0 holds it.
  static constexpr int kLeast = -900;
  const auto about_zero = [](int exponent) {
    const double r = std::ldexp(1.0, std::max(exponent, kLeast));
    return FineInterval(exact::Interval(-r, r));
  };
  if (high.exponent + shift < kLeast + 110) return about_zero(high.exponent + shift + 1);
  Big rest = v;
  const auto take = [&](const exact::BinaryParts& part) {
    const Big mantissa = Big::from_int64(static_cast<std::int64_t>(std::ldexp(part.mantissa, 53)));
    const int power = part.exponent - 53;
    // Fewer digits than a double has: the last ones of the mantissa are zeros.
    rest = rest - (power >= 0 ? Big(exact::BigInteger(mantissa.value() << power))
                              : Big(exact::BigInteger(mantissa.value() / (exact::BigInteger(1) << -power))));
  };
  take(high);
  const exact::BinaryParts low = exact::binary_parts(rest);
  if (low.is_zero()) return FineInterval(high.scaled(shift));
  take(low);
  const FineInterval both = FineInterval::difference(-low.scaled(shift), high.scaled(shift));
  const exact::BinaryParts left = exact::binary_parts(rest);
  return left.is_zero() ? both : both + about_zero(left.exponent + shift);
}

}  // namespace dymsum::spatial

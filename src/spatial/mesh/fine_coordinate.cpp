#include "spatial/mesh/fine_coordinate.h"

#include <algorithm>
#include <cmath>

#include "exact/big.h"

namespace dymsum::spatial {

namespace {

/// The exponent below which an interval about 0 holds what is left.
constexpr int kLeastExponent = -900;

/// All of at most 2^exponent.
exact::FineInterval up_to_power(int exponent) {
  const double r = std::ldexp(1.0, std::max(exponent, kLeastExponent));
  return exact::FineInterval(exact::Interval(-r, r));
}

}  // namespace

exact::FineInterval fine_coordinate(const exact::Big& v, int shift) {
  using exact::Big;
  using exact::FineInterval;
  const exact::BinaryParts high = exact::binary_parts(v);
  if (high.is_zero()) return {};
  // What is left behind two doubles is held by an interval about 0, too.
  if (high.exponent + shift < kLeastExponent + 110) return up_to_power(high.exponent + shift + 1);
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
  return left.is_zero() ? both : both + up_to_power(left.exponent + shift);
}

exact::FineInterval fine_coordinate(const exact::RootValue& v, int shift) {
  if (v.terms().empty()) return {};
  if (v.at() == nullptr || v.terms().size() == 1) return fine_coordinate(exact::Big(v.terms()[0]), shift);
  const exact::RootPoint::Enclosure e = v.at()->enclose(v.terms(), 160);
  shift -= static_cast<int>(e.scale);
  const exact::FineInterval midpoint = fine_coordinate(exact::Big(e.value), shift);
  return e.error.is_zero() ? midpoint : midpoint + up_to_power(static_cast<int>(msb(e.error)) + 1 + shift);
}

exact::WideInterval wide_coordinate(const exact::RootValue& v, int shift) {
  if (v.terms().empty()) return {};
  if (v.at() == nullptr || v.terms().size() == 1) return exact::WideInterval::around(v.terms()[0], 0, shift);
  // Coefficients are hardly larger than the value, as roots are below 1 in a chart: the error is about the last place.
  const exact::RootPoint::Enclosure e = v.at()->enclose(v.terms(), exact::WideInterval::kFractionBits + 8);
  return exact::WideInterval::around(e.value, e.error, shift - static_cast<long>(e.scale));
}

}  // namespace dymsum::spatial

#include "spatial/mesh/wide_sum.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "exact/big.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using exact::FineInterval;

namespace {

int longest(const LengthSum& sum) {
  int top = 0;
  for (const exact::Vector3<Big>& v : sum.vectors) top = std::max(top, bit_length(v));
  return top;
}

/// Nothing where the sum is none of the normal doubles, or may be nearest to two.
std::optional<double> nearest_by_fine_doubles(const LengthSum& sum) {
  const int top = longest(sum);
  FineInterval total;
  for (const exact::Vector3<Big>& v : sum.vectors) {
    const FineInterval x = fine_coordinate(v.x, -top), y = fine_coordinate(v.y, -top), z = fine_coordinate(v.z, -top);
    total = total + sqrt(x * x + y * y + z * z);
  }
  const Big num(numerator(sum.unit)), den(denominator(sum.unit));
  const int num_bits = bit_length(num), den_bits = bit_length(den);
  const FineInterval unit = fine_coordinate(num, -num_bits) / fine_coordinate(den, -den_bits);
  const std::optional<double> value = (total * unit).nearest();
  if (!value) return value;
  const double result = std::ldexp(*value, top + num_bits - den_bits);
  return *value == 0 || std::isnormal(result) ? std::optional(result) : std::nullopt;
}

/// Calls decide(low, high) with narrower and narrower bounds of the sum until it returns true.
template <class F>
void narrow(const LengthSum& sum, F decide) {
  const int top = longest(sum);
  for (int digits = 128;; digits *= 2) {
    const int shift = std::max(digits - top, 0);
    BigInteger low = 0, cut = 0;  // how many roots are less than 1 too small
    for (const exact::Vector3<Big>& v : sum.vectors) {
      const BigInteger square = exact::dot(v, v).value();
      BigInteger rest;
      low += exact::floor_root(BigInteger(square << (2 * shift)), rest);
      if (!rest.is_zero()) ++cut;
    }
    const BigRational step = sum.unit / (BigInteger(1) << shift);
    if (decide(BigRational(low * step), BigRational((low + cut) * step)) || cut.is_zero()) return;
  }
}

}  // namespace

double LengthSum::nearest() const {
  if (const std::optional<double> value = nearest_by_fine_doubles(*this)) return *value;
  double value = 0;
  narrow(*this, [&](const BigRational& low, const BigRational& high) {
    value = exact::round_to_double(low);
    return exact::round_to_double(high) == value;
  });
  return value;
}

std::string LengthSum::text() const {
  std::string digits;
  narrow(*this, [&](const BigRational& low, const BigRational& high) {
    digits = exact::decimal_text(low, 17);
    return exact::decimal_text(high, 17) == digits;
  });
  return digits;
}

}  // namespace dymsum::spatial

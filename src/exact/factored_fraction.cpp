#include "exact/factored_fraction.h"

namespace dymsum::exact {

BigInteger product_of(std::span<const BigInteger> factors) {
  if (factors.empty()) return 1;
  if (factors.size() == 1) return factors[0];
  return product_of(factors.first(factors.size() / 2)) * product_of(factors.subspan(factors.size() / 2));
}

namespace {

/// The product over factors f of gcd(f, value): the value's remainder is taken by ever smaller products of factors.
BigInteger product_of_gcds(std::span<const BigInteger> factors, const BigInteger& value) {
  if (factors.size() == 1) return gcd(factors[0], BigInteger(value % factors[0]));
  const auto left = factors.first(factors.size() / 2), right = factors.subspan(factors.size() / 2);
  return product_of_gcds(left, BigInteger(value % product_of(left))) *
         product_of_gcds(right, BigInteger(value % product_of(right)));
}

}  // namespace

// With D the product of the factors f, gcd(N, D) = gcd(N, product of gcd(f, N)): for every prime, the smaller of its
// powers in N and D is the smaller of that in N and the sum over f of the smaller of those in N and f.
BigInteger gcd_with_product(std::span<const BigInteger> factors, const BigInteger& value) {
  if (factors.empty()) return 1;
  const BigInteger magnitude = abs(value);
  const BigInteger part = product_of_gcds(factors, BigInteger(magnitude % product_of(factors)));
  return gcd(part, BigInteger(magnitude % part));
}

}  // namespace dymsum::exact

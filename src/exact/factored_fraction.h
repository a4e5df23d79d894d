// Fractions whose denominators are products of known factors: lowest terms without the greatest common divisor of two
// long integers.
#pragma once

#include <span>

#include "exact/big.h"

namespace dymsum::exact {

/// The product, by halves. 1 of none.
BigInteger product_of(std::span<const BigInteger> factors);

/// gcd(value, product of the factors), for a value that is not 0. Cost: O(M(b) log n) for n factors of b bits together,
/// and a gcd of b bits only where all factors have a part in common with the value.
BigInteger gcd_with_product(std::span<const BigInteger> factors, const BigInteger& value);

}  // namespace dymsum::exact

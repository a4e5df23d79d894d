#include "planar/position/exact_area.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "exact/factored_fraction.h"

namespace dymsum::planar {

namespace {

using exact::BigInteger;

/// A fraction with a product of known factors as denominator.
struct Fraction {
  BigInteger numerator, denominator;
};

/// The cross products of edges first .. last - 1 of a ring sum up to numerator / (w(first) denominator w(last)). Two
/// neighbours share one w, so every w enters the denominator once.
Fraction chain_sum(std::span<const Homogeneous> ring, std::size_t first, std::size_t last) {
  const Homogeneous& a = ring[first];
  const Homogeneous& b = ring[last % ring.size()];
  if (last - first == 1) return {a.x * b.y - b.x * a.y, 1};
  const std::size_t midpoint = (first + last) / 2;
  const Fraction left = chain_sum(ring, first, midpoint), right = chain_sum(ring, midpoint, last);
  const BigInteger after = right.denominator * b.w, before = a.w * left.denominator;
  const BigInteger shared = left.denominator * ring[midpoint].w;
  return {left.numerator * after + right.numerator * before, shared * right.denominator};
}

/// Unreduced sum of the rings' cross products.
Fraction ring_sums(std::span<const std::vector<Homogeneous>> rings) {
  if (rings.size() == 1) {
    const std::vector<Homogeneous>& ring = rings[0];
    Fraction sum = chain_sum(ring, 0, ring.size());
    sum.denominator *= ring[0].w * ring[0].w;
    return sum;
  }
  const Fraction left = ring_sums(rings.first(rings.size() / 2)), right = ring_sums(rings.subspan(rings.size() / 2));
  return {left.numerator * right.denominator + right.numerator * left.denominator,
          left.denominator * right.denominator};
}

}  // namespace

Rational ExactArea::to_rational() const { return exact::to_rational(numerator, denominator); }

// The quotient's first 64 bits or more, and a last bit set when something follows: this rounds as the quotient does.
double ExactArea::to_double() const {
  if (numerator.is_zero()) return 0;
  const BigInteger magnitude = abs(numerator);
  const auto shift = static_cast<std::int64_t>(msb(denominator)) - static_cast<std::int64_t>(msb(magnitude)) + 64;
  BigInteger quotient, remainder;
  if (shift >= 0) divide_qr(BigInteger(magnitude << shift), denominator, quotient, remainder);
  else divide_qr(magnitude, BigInteger(denominator << -shift), quotient, remainder);
  quotient <<= 1;
  if (!remainder.is_zero()) quotient += 1;
  if (numerator.sign() < 0) quotient = -quotient;
  const BigInteger scale = BigInteger(1) << (shift >= 0 ? shift + 1 : -shift);
  if (shift >= 0) return exact::round_to_double(exact::BigRational(quotient, scale));
  return exact::round_to_double(exact::BigRational(quotient * scale, 2));
}

namespace {

/// All vertices in units of one power of two, the largest of all denominators: what is left of these is odd. Returns
/// its exponent.
unsigned leave_odd(std::vector<std::vector<Homogeneous>>& rings) {
  unsigned twos = 0;
  for (const auto& ring : rings)
    for (const Homogeneous& v : ring) twos = std::max(twos, static_cast<unsigned>(lsb(v.w)));
  for (auto& ring : rings)
    for (Homogeneous& v : ring) {
      const auto own = static_cast<unsigned>(lsb(v.w));
      v.w >>= own;
      v.x <<= twos - own;
      v.y <<= twos - own;
    }
  return twos;
}

}  // namespace

ExactArea exact_area(const std::vector<std::vector<Position>>& rings) {
  std::vector<std::vector<Homogeneous>> vertices(rings.size());
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (const Position& p : rings[i]) vertices[i].push_back(homogeneous(p));
  return exact_area(std::move(vertices));
}

// The odd factors of the denominator are known; twos are counted.
ExactArea exact_area(std::vector<std::vector<Homogeneous>> rings) {
  std::erase_if(rings, [](const std::vector<Homogeneous>& ring) { return ring.empty(); });
  if (rings.empty()) return {};
  const unsigned twos = 2 * leave_odd(rings) + 1;
  std::vector<BigInteger> factors{1};
  for (const std::vector<Homogeneous>& ring : rings) {
    for (const Homogeneous& v : ring)
      if (v.w != 1) factors.push_back(v.w);
    if (ring[0].w != 1) factors.push_back(ring[0].w);
  }
  Fraction sum = ring_sums(rings);
  if (sum.numerator.is_zero()) return {};
  const BigInteger common = exact::gcd_with_product(factors, sum.numerator);
  const unsigned shared = std::min(twos, static_cast<unsigned>(lsb(abs(sum.numerator))));
  return {BigInteger(sum.numerator / common) >> shared, BigInteger(sum.denominator / common) << (twos - shared)};
}

}  // namespace dymsum::planar

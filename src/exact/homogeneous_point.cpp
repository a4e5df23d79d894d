#include "exact/homogeneous_point.h"

#include <algorithm>

#include "exact/grid.h"

namespace dymsum::exact {

HomogeneousPoint without_twos(HomogeneousPoint p) {
  unsigned twos = static_cast<unsigned>(lsb(p.w));
  for (const BigInteger* v : {&p.x, &p.y})
    if (twos > 0 && !v->is_zero()) twos = std::min(twos, static_cast<unsigned>(lsb(BigInteger(abs(*v)))));
  if (twos > 0)
    for (BigInteger* v : {&p.x, &p.y, &p.w}) *v >>= twos;
  return p;
}

HomogeneousPoint in_lowest_terms(HomogeneousPoint p) {
  p = without_twos(std::move(p));
  // Most denominators are powers of two, which need no greatest common divisor.
  if (msb(p.w) == lsb(p.w)) {
    if (p.x.is_zero() && p.y.is_zero()) p.w = 1;
    return p;
  }
  const BigInteger common = gcd(gcd(p.x, p.w), p.y);
  if (common != 1)
    for (BigInteger* v : {&p.x, &p.y, &p.w}) *v /= common;
  return p;
}

HomogeneousPoint homogeneous(double x, double y) {
  const Dyadic a = to_dyadic(x), b = to_dyadic(y);
  const int low = std::min({a.mantissa == 0 ? 0 : a.exponent, b.mantissa == 0 ? 0 : b.exponent, 0});
  const auto numerator = [&](const Dyadic& d) {
    return d.mantissa == 0 ? BigInteger(0) : BigInteger(BigInteger(d.mantissa) << (d.exponent - low));
  };
  return {numerator(a), numerator(b), BigInteger(1) << -low};
}

}  // namespace dymsum::exact

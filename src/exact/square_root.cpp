#include "exact/square_root.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace dymsum::exact {

// With num / den scaled by 4^k to at least 2^128, its root has at least 64 bits: r, its whole part, and one more bit
// that says whether something follows. Doubles and the midpoints between two of them have at most 54 bits, so the
// number made of r and that bit lies on the same side of each of them as the root does, or is the same.
double root_to_double(const BigRational& v) {
  if (v < 0) throw std::logic_error("root_to_double: of a negative number");
  if (v.is_zero()) return 0;
  BigInteger num = numerator(v), den = denominator(v);
  const int size = static_cast<int>(msb(num)) - static_cast<int>(msb(den));  // num / den > 2^(size - 1)
  const int k = size >= 130 ? 0 : (130 - size) / 2;
  num <<= static_cast<unsigned>(2 * k);
  BigInteger whole, rest, left;
  divide_qr(num, den, whole, rest);
  const BigInteger r = floor_root(whole, left);
  const BigInteger r_and_more = 2 * r + (left != 0 || rest != 0 ? 1 : 0);
  return round_to_double(BigRational(r_and_more, BigInteger(1) << static_cast<unsigned>(k + 1)));
}

// Newton's iteration from above falls until it reaches the root rounded down.
BigInteger floor_root(const BigInteger& n, BigInteger& rest) {
  rest = 0;
  if (n.is_zero()) return 0;
  // At most 62 leading bits, an even number of them cut off: their root in doubles, rounded up.
  const unsigned length = static_cast<unsigned>(msb(n)) + 1, cut = length <= 62 ? 0 : (length - 61) / 2 * 2;
  const double leading = std::sqrt(static_cast<double>(static_cast<std::uint64_t>(n >> cut)) + 1);
  BigInteger root = (BigInteger(static_cast<std::uint64_t>(leading)) + 2) << (cut / 2);
  for (;;) {
    BigInteger next = (root + n / root) >> 1;
    if (next >= root) break;
    root = std::move(next);
  }
  rest = n - root * root;
  return root;
}

}  // namespace dymsum::exact

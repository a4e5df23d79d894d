// Real numbers known to some precision, however large: a binary number and how far off it may be. For exact decisions
// that need more bits than doubles have.
#pragma once

#include <cstdint>
#include <optional>

#include "exact/big.h"
#include "exact/interval.h"

namespace dymsum::exact {

/// All x with |x - centre 2^exponent| <= radius 2^exponent. Results have about `precision` bits at most: what is cut
/// off, and what roots and quotients leave, goes into the radius. Exponents have room for any sum of sizes in memory.
class Ball {
 public:
  Ball() = default;  ///< exactly 0
  Ball(BigInteger centre, BigInteger radius, std::int64_t exponent, unsigned precision);

  /// a + b or, for the sign -1, a - b.
  static Ball sum(const Ball& a, const Ball& b, int sign_of_b, unsigned precision);
  static Ball product(const Ball& a, const Ball& b, unsigned precision);
  /// Nothing where b contains 0.
  static std::optional<Ball> quotient(const Ball& a, const Ball& b, unsigned precision);
  /// The roots of the numbers that are not negative. Requires that there are some.
  static Ball root(const Ball& a, unsigned precision);

  /// The sign of all its numbers, if they have one.
  std::optional<int> sign() const;
  /// All |x| < 2^top(); the least exponent for exactly 0.
  std::int64_t top() const;
  /// radius <= 2^-bits |centre|.
  bool is_narrow(unsigned bits) const;
  /// The smallest interval of doubles that contains it.
  Interval rounded_outwards() const;

 private:
  void move_to(std::int64_t exponent);

  BigInteger centre_ = 0, radius_ = 0;
  std::int64_t exponent_ = 0;
};

}  // namespace dymsum::exact

// Classes of integers whose square roots are rational multiples of each other, or of products of each other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/big.h"

namespace dymsum::exact {

/// Whether n >= 0 is the square of an integer, put into root. Few others get as far as the root.
std::optional<BigInteger> root_of_square(const BigInteger& n);

/// A bit for each of 32 primes: whether n without its divisors p is no square modulo p. The word of a product is the
/// exclusive or of the words; a square's is 0. Requires n > 0.
std::uint32_t square_characters(const BigInteger& n);

/// Positive integers of which no product of different ones is a square: their characters are linearly independent.
class SquareClasses {
 public:
  /// n times the members in a set is the square of root.
  struct Relation {
    std::uint32_t members = 0;
    BigInteger root;
  };

  const std::vector<BigInteger>& members() const { return members_; }
  /// How n > 0 depends on the members, of which it becomes the last one where it did not depend on the others. Nothing,
  /// and no change, where the characters do not decide: once in 2^32 / 2^members.
  std::optional<Relation> add(const BigInteger& n);

 private:
  struct Row {
    std::uint32_t characters;
    std::uint32_t members;
  };
  std::vector<BigInteger> members_;
  std::vector<Row> rows_;
};

}  // namespace dymsum::exact

#include "spatial/sum/common_grid.h"

#include <algorithm>
#include <climits>
#include <optional>

namespace dymsum::spatial {

namespace {

using exact::BigInteger;
using exact::BigRational;

/// The powers of two of the lowest and of the highest digit of all coordinates, and their common odd denominator.
class Digits {
 public:
  void add(const BigRational& c, int most_bits) {
    if (c.is_zero()) return;
    const BigInteger above = abs(numerator(c)), below = denominator(c);
    const int zeros = static_cast<int>(lsb(below));
    low_ = std::min(low_.value_or(INT_MAX), static_cast<int>(lsb(above)) - zeros);
    high_ = std::max(high_.value_or(INT_MIN), static_cast<int>(msb(above)) - static_cast<int>(msb(below)) + 1);
    if (static_cast<int>(msb(scale_)) <= most_bits) scale_ = lcm(scale_, BigInteger(below >> zeros));
  }
  CommonGrid grid(int most_bits) const {
    if (!low_) return {};
    constexpr int kBits = 60;  // of the largest coordinate before the point
    const int needed = *high_ - *low_ + static_cast<int>(msb(scale_)) + 1;
    return scale_ != 1 && needed > most_bits ? CommonGrid{1, *high_ - kBits} : CommonGrid{scale_, *low_};
  }

 private:
  std::optional<int> low_, high_;
  BigInteger scale_ = 1;
};

exact::Fraction in_units(const CommonGrid& grid, const BigRational& c) {
  BigInteger above = numerator(c) * grid.scale, below = denominator(c);
  if (grid.exponent <= 0) above <<= -grid.exponent;
  else below <<= grid.exponent;
  const BigInteger common = gcd(above, below);
  return exact::Fraction(above / common, below / common);
}

}  // namespace

CommonGrid common_grid(std::span<const ExactSet* const> sets, int most_bits) {
  Digits digits;
  for (const ExactSet* set : sets)
    for (const ExactPosition& at : set->at)
      for (const BigRational& c : at) digits.add(c, most_bits);
  return digits.grid(most_bits);
}

std::vector<ExactVertex> vertices_on(const CommonGrid& grid, const ExactSet& set) {
  std::vector<ExactVertex> vertices;
  vertices.reserve(set.at.size());
  for (const ExactPosition& at : set.at)
    vertices.push_back({in_units(grid, at[0]), in_units(grid, at[1]), in_units(grid, at[2])});
  return vertices;
}

}  // namespace dymsum::spatial

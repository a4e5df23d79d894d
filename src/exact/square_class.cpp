#include "exact/square_class.h"

#include <array>
#include <bit>
#include <utility>

#include "exact/square_root.h"

namespace dymsum::exact {

namespace {

/// Odd primes below 2^8, eight to a product below 2^64.
constexpr std::array<std::array<std::uint64_t, 8>, 4> kPrimes{{{67, 71, 73, 79, 83, 89, 97, 101},
                                                               {103, 107, 109, 113, 127, 131, 137, 139},
                                                               {149, 151, 157, 163, 167, 173, 179, 181},
                                                               {191, 193, 197, 199, 211, 223, 227, 229}}};

/// Bit k of the set tells that k is a square modulo the number.
struct Squares {
  std::array<std::uint64_t, 4> bits{};
  constexpr explicit Squares(std::uint64_t number) {
    for (std::uint64_t k = 0; k < number; ++k) bits[k * k % number / 64] |= std::uint64_t{1} << (k * k % number % 64);
  }
  constexpr bool has(std::uint64_t k) const { return (bits[k / 64] >> (k % 64) & 1) != 0; }
};

constexpr std::array<std::uint64_t, 8> kSieve{63, 11, 13, 17, 19, 23, 29, 31};
constexpr std::uint64_t product_of(const std::array<std::uint64_t, 8>& numbers) {
  std::uint64_t product = 1;
  for (const std::uint64_t n : numbers) product *= n;
  return product;
}

template <std::size_t... I>
constexpr std::array<Squares, 8> squares_of(const std::array<std::uint64_t, 8>& numbers, std::index_sequence<I...>) {
  return {Squares(numbers[I])...};
}
constexpr std::array<Squares, 8> squares_of(const std::array<std::uint64_t, 8>& numbers) {
  return squares_of(numbers, std::make_index_sequence<8>{});
}

std::uint64_t remainder(const BigInteger& n, std::uint64_t m) { return static_cast<std::uint64_t>(BigInteger(n % m)); }

/// The two characters of n at p, which divides it: bit 32 and bit 0.
std::uint64_t characters_at_divisor(BigInteger n, std::uint64_t p, const Squares& squares) {
  std::uint64_t odd = 0;
  for (; remainder(n, p) == 0; odd ^= 1) n /= p;
  return odd << 32 | (squares.has(remainder(n, p)) ? 0U : 1U);
}

}  // namespace

std::optional<BigInteger> root_of_square(const BigInteger& n) {
  if (n.is_zero()) return n;
  const auto twos = static_cast<unsigned>(lsb(n));
  if (twos % 2 != 0 || static_cast<std::uint64_t>(BigInteger((n >> twos) & 7)) != 1) return std::nullopt;
  static constexpr std::array<Squares, 8> kSquares = squares_of(kSieve);
  const std::uint64_t rest = remainder(n, product_of(kSieve));
  for (std::size_t i = 0; i < 8; ++i)
    if (!kSquares[i].has(rest % kSieve[i])) return std::nullopt;
  BigInteger left;
  BigInteger root = floor_root(n, left);
  if (!left.is_zero()) return std::nullopt;
  return root;
}

std::uint64_t square_characters(const BigInteger& n) {
  static constexpr std::array<std::array<Squares, 8>, 4> kSquares{squares_of(kPrimes[0]), squares_of(kPrimes[1]),
                                                                  squares_of(kPrimes[2]), squares_of(kPrimes[3])};
  std::uint64_t result = 0;
  for (std::size_t g = 0; g < 4; ++g) {
    const std::uint64_t rest = remainder(n, product_of(kPrimes[g]));
    for (std::size_t i = 0; i < 8; ++i) {
      const std::uint64_t p = kPrimes[g][i], k = rest % p;
      const std::uint64_t at = k != 0 ? (kSquares[g][i].has(k) ? 0U : 1U) : characters_at_divisor(n, p, kSquares[g][i]);
      result |= at << (8 * g + i);
    }
  }
  return result;
}

// Each row is the word of the product of some members, and no two rows have the same lowest bit.
std::optional<SquareClasses::Relation> SquareClasses::add(const BigInteger& n) {
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (members_[k] == n) return Relation{std::uint32_t{1} << k, n};
  Row row{square_characters(n), 0};
  for (const Row& known : rows_) {
    if ((row.characters & (known.characters & -known.characters)) == 0) continue;
    row.characters ^= known.characters;
    row.members ^= known.members;
  }
  if (row.characters == 0) {
    BigInteger product = n;
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (row.members >> k & 1) product *= members_[k];
    std::optional<BigInteger> root = root_of_square(product);
    if (!root) return std::nullopt;
    return Relation{row.members, std::move(*root)};
  }
  if (members_.size() == 32) return std::nullopt;
  const auto own = std::uint32_t{1} << members_.size();
  row.members ^= own;
  rows_.push_back(row);
  members_.push_back(n);
  return Relation{own, n};
}

}  // namespace dymsum::exact

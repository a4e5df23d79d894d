// Exact real numbers made of integers and doubles by + - * / and square roots.
//
// A sign is asked of intervals of doubles first, which every number carries, then of intervals of 128, 256 and 512
// bits, then, as it may be zero, of the algebra of square roots of rationals where that is cheap (exact/root_field),
// then of intervals of growing precision again. These end at a bound below which no nonzero expression of this form
// lies:
//
// Theorem (after Burnikel, Fleischer, Mehlhorn, Schirra 2000 and, with quotients, Burnikel, Funke, Mehlhorn, Schirra,
// Schmitt 2001). Let E be an expression of integers with k distinct roots among its subexpressions, and
//   integer N:  u = max(|N|, 1), l = 1        A + B:  u = u_A l_B + l_A u_B, l = l_A l_B     (A - B the same)
//   A * B:      u = u_A u_B, l = l_A l_B      A / B:  u = u_A l_B, l = l_A u_B
//   sqrt A:     u = sqrt(u_A l_A), l = l_A, or u = u_A, l = sqrt(u_A l_A).
// Then E = 0 or |E| >= 1 / (u^(2^k - 1) l).
//
// Proof. By the rules E = U / L with U and L made of integers and k roots by + - * alone: sqrt(U_A / L_A) is
// +-sqrt(U_A L_A) / L_A or U_A / +-sqrt(U_A L_A), with one new root, of U_A L_A, either way. So U and L are algebraic
// integers in a tower of k quadratic extensions of the rationals, of degree d <= 2^k. Let s be one of its d embeddings
// into the complex numbers. It maps sums and products to such, integers to themselves and a root of X to a root of
// s(X), so that |s(U)| <= u and |s(L)| <= l by induction over the rules: sums and products at most add and multiply
// magnitudes, and |s(sqrt X)| = |s(X)|^(1/2). If U is not 0, the product of all s(U) is an integer and not 0, hence
// |U| >= 1 / u^(d - 1), with u >= 1 as the product is at most u^d; and |E| = |U| / |L| >= 1 / (u^(d - 1) l).
//
// The bound is the exact exponent of a computation: bits = (2^k - 1) log2 u + log2 l, all logarithms rounded up.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "exact/big.h"
#include "exact/interval.h"
#include "exact/orient.h"

namespace dymsum::exact {

// Classes of integers whose square roots are rational multiples of each other, or of products of each other.

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

// What root expressions are made of.

/// The precision of the first look beyond doubles.
inline constexpr unsigned kFirstPrecision = 128;
/// The precision of the last look before algebra is asked: balls of so many bits take tens of microseconds, algebra
/// up to 20 ms. Numbers that are not zero and need more are rare.
inline constexpr unsigned kLastBeforeAlgebra = 512;

/// Immutable; shared by the expressions that it occurs in.
struct RootNode {
  enum class Kind : std::uint8_t { rational, sum, difference, product, quotient, root };

  Kind kind = Kind::rational;
  Interval interval;                     ///< contains the number
  std::uint64_t log_u = 0, log_l = 0;    ///< the theorem's u <= 2^log_u, l <= 2^log_l
  BigInteger num = 0, den = 1;           ///< rational: lowest terms, den > 0
  std::shared_ptr<const RootNode> a, b;  ///< operands; a alone of a root

  bool is_rational() const { return kind == Kind::rational; }
};

/// True only if they are equal: one node, or the same rational.
bool has_same_value(const RootNode& a, const RootNode& b);

/// A sign, and who determined it: one after the other is asked.
struct NodeAnswer {
  enum class By : std::uint8_t {
    doubles,            ///< the node's interval, or its rational
    precision,          ///< balls of 128, 256 or 512 bits
    algebra,            ///< it is zero
    precision_at_last,  ///< balls of more bits; algebra has said that it is not zero, or nothing
    bound,              ///< it is less than what is not zero
  };
  int sign = 0;
  By by = By::doubles;
};
/// Exact.
NodeAnswer answer_of_node(const RootNode& node);
SignAnswer sign_of_node(const RootNode& node);

/// The distinct parts of an expression, operands before what is made of them.
class RootParts {
 public:
  explicit RootParts(const RootNode& node);

  /// If E is not zero, |E| >= 2^-bits.
  std::uint64_t separation_bits() const;
  /// Contains E; nothing where the precision does not tell a divisor from 0.
  std::optional<Ball> value(unsigned precision) const;

  struct Part {
    const RootNode* node;
    std::uint32_t a, b;  ///< operands among the parts; 0 where there is none
  };
  const std::vector<Part>& all() const { return parts_; }

 private:
  std::uint32_t add(const RootNode& node, std::unordered_map<const RootNode*, std::uint32_t>& positions);
  std::vector<Part> parts_;
};

struct RootNode;

/// An immutable value: copies share its parts, threads may too. Building one costs as much as one operation on the
/// integers in it, unless what is under a root or below a line may be zero: its sign is found first.
class RootExpression {
 public:
  RootExpression();  ///< 0
  /// Exactly v. Throws std::domain_error for NaN and infinities.
  explicit RootExpression(double v);
  template <std::integral Integer>
  explicit RootExpression(Integer v) : RootExpression(BigInteger(v)) {}
  explicit RootExpression(const BigInteger& v);
  explicit RootExpression(const Big& v) : RootExpression(v.value()) {}
  template <int B>
  explicit RootExpression(const Int<B>& v) : RootExpression(Big(v)) {}
  explicit RootExpression(const BigRational& v);

  friend RootExpression operator-(const RootExpression& a);
  friend RootExpression operator+(const RootExpression& a, const RootExpression& b);
  friend RootExpression operator-(const RootExpression& a, const RootExpression& b);
  friend RootExpression operator*(const RootExpression& a, const RootExpression& b);
  /// Throws std::domain_error where b is 0.
  friend RootExpression operator/(const RootExpression& a, const RootExpression& b);
  /// The root that is not negative. Throws std::domain_error where a is negative. Roots of squares of rationals are
  /// rational.
  friend RootExpression sqrt(const RootExpression& a);
  friend RootExpression square(const RootExpression& a) { return a * a; }
  friend RootExpression& operator+=(RootExpression& a, const RootExpression& b) { return a = a + b; }
  friend RootExpression& operator-=(RootExpression& a, const RootExpression& b) { return a = a - b; }
  friend RootExpression& operator*=(RootExpression& a, const RootExpression& b) { return a = a * b; }
  friend RootExpression& operator/=(RootExpression& a, const RootExpression& b) { return a = a / b; }

  /// It contains the number. Immediate.
  const Interval& interval() const;
  const RootNode& node() const { return *node_; }

 private:
  explicit RootExpression(std::shared_ptr<const RootNode> node) : node_(std::move(node)) {}
  std::shared_ptr<const RootNode> node_;
};

/// Exact. Nanoseconds where intervals decide; microseconds to a few hundred of them for zeros with up to six roots, two
/// of them nested. Where algebra gives up, a zero costs what the bound's bits do; throws std::length_error past 2^28.
SignAnswer sign_answer(const RootExpression& a);
inline int sign_of(const RootExpression& a) { return sign_answer(a).sign; }
inline int sign_of(const RootExpression& a, RungCounts& counts) { return counts.add(sign_answer(a)); }

/// -1, 0, 1 for a < b, a = b, a > b. Exact.
SignAnswer compare_answer(const RootExpression& a, const RootExpression& b);
inline int compare(const RootExpression& a, const RootExpression& b) { return compare_answer(a, b).sign; }
inline int compare(const RootExpression& a, const RootExpression& b, RungCounts& counts) {
  return counts.add(compare_answer(a, b));
}

/// The double nearest to a, ties to even; infinite past the range of doubles, +0 for what rounds to 0.
double nearest_double(const RootExpression& a);
/// Contains a; its ends are neighbours, two steps apart where a may be the double between them, equal only if they are
/// a. The whole line past the range of doubles.
Interval narrow_interval(const RootExpression& a);

/// The expression as a formula of integers, + - * / and sqrt(): "sqrt(2) + 3/4". As long as the expression without
/// sharing.
std::string to_text(const RootExpression& a);

}  // namespace dymsum::exact

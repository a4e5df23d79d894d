// What root expressions are made of.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "exact/ball.h"
#include "exact/big.h"
#include "exact/interval.h"
#include "exact/rung.h"

namespace dymsum::exact {

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

}  // namespace dymsum::exact

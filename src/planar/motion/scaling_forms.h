// The signs of the convolution as polynomials of the scale s: linear, with integer coefficients.
// docs/design/scaling-sum.md, "Numbers".
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planar/motion/operand_pair.h"

namespace dymsum::planar {

/// a + b s.
struct ExactForm {
  exact::BigInteger a = 0, b = 0;
  bool always_zero() const { return a == 0 && b == 0; }
  /// The one positive scale at which it vanishes, if it is not constant.
  std::optional<exact::BigRational> root() const {
    if (b == 0 || a.sign() * b.sign() >= 0) return std::nullopt;
    return exact::ratio(exact::Big(exact::BigInteger(-a)), exact::Big(b));
  }
  int sign_at(const exact::BigRational& s) const {
    return exact::BigInteger(a * denominator(s) + b * numerator(s)).sign();
  }
};

class ExactForms {
 public:
  explicit ExactForms(const OperandPair& base);

  /// d x (v - start) for the unscaled edge d of the segment.
  ExactForm side(const Segment& s, Pair v) const;
  /// d . (v - start): with the scale's square, as both d and v scale; the sign of d . (v - start) over the edge's own
  /// length.
  ExactForm along(const Segment& s, Pair v) const;
  /// Vanishes where the lines of three segments meet in a point. Requires: no two of them parallel.
  ExactForm concurrent(const Segment& a, const Segment& b, const Segment& c) const;
  /// A hash of the line of a segment as it moves with s, and of its direction: equal for segments whose lines coincide
  /// at every scale.
  std::uint64_t line_hash(const Segment& s) const;

 private:
  struct Vec {
    exact::BigInteger x, y;
  };
  Vec edge(const Edge& e) const;
  ExactForm cross(const Vec& d, Pair v) const;

  std::uint32_t scaled_;
  std::array<std::vector<Vec>, 2> at_;  ///< relative to the operands' offsets
};

}  // namespace dymsum::planar

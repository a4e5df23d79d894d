// Exact positive scales.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "dymsum/rational.h"
#include "dymsum/result.h"

namespace dymsum {

/// An exact scale s with 2^-64 <= s <= 2^64; numerator and denominator have at most 4096 bits.
class Scale {
 public:
  Scale() = default;  ///< 1

  /// The double at face value. Errors: not_finite for NaN and infinities; bad_scale for zero, negative and out of
  /// range.
  static Result<Scale> of(double value);
  /// Errors: bad_scale as above, and for numerators and denominators of more than 4096 bits.
  static Result<Scale> of(const Rational& value);
  /// "3/2", "1.01" or "1e-3", each exactly what it says: 1.01 is 101/100. Errors: malformed; bad_scale.
  static Result<Scale> parse(std::string_view text);

  const Rational& exact() const { return value_; }
  double approx() const { return approx_; }  ///< the nearest double
  friend bool operator==(const Scale& a, const Scale& b) { return a.value_ == b.value_; }

 private:
  Rational value_ = 1;
  double approx_ = 1;
};

/// The same as Scale::parse, for the step of scale_steps: errors speak of steps.
Result<Scale> parse_scale_step(std::string_view text);

/// How a step leads from one scale to the next.
enum class StepKind : std::uint8_t {
  difference,  ///< s + step, or s - step on the way down
  percent,     ///< (1 + step / 100) s, or s / (1 + step / 100), rounded down to a multiple of 2^-40: numbers stay short
};

/// The scales from `from` to `to` in steps, both ends included exactly: the last step may be shorter, and the way leads
/// down where `to` is smaller. Errors: bad_scale for more than `most` scales, and for steps that rounding leaves
/// nothing of.
Result<std::vector<Scale>> scale_steps(const Scale& from, const Scale& to, const Scale& step, StepKind kind,
                                       std::size_t most);

}  // namespace dymsum

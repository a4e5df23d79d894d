// Exact rational numbers as they leave the library: a value to print, compare and hand on, not to compute with.
#pragma once

#include <string>

namespace dymsum {

/// num/den in lowest terms, den > 0, both as decimal digits ("-" in front of a negative num). Equal numbers are equal
/// values.
struct Rational {
  std::string num = "0";
  std::string den = "1";

  /// "num/den", also when den is 1.
  std::string to_string() const { return num + "/" + den; }
  /// The nearest double (ties to even); infinite past the double range.
  double to_double() const;
  friend bool operator==(const Rational&, const Rational&) = default;
};

struct RationalPoint {
  Rational x, y;
  friend bool operator==(const RationalPoint&, const RationalPoint&) = default;
};

}  // namespace dymsum

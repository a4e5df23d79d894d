// Numbers, points and angles as they are written on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dymsum/rational.h"
#include "dymsum/region.h"

namespace dymsum::cli {

/// The double nearest to a decimal number; nothing for other text, for NaN and infinities, and past the range of
/// doubles.
std::optional<double> finite_number(const std::string& text);

/// The length of a vector in space, with the same roundings everywhere: standard libraries differ in std::hypot of
/// three.
double length_of(double x, double y, double z);

/// The text between separators; one more piece than separators.
std::vector<std::string> split(const std::string& text, char separator);

/// So many doubles with commas between, also as fractions that doubles are; wrong usage that says `what` else.
std::vector<double> numbers_of(const std::string& text, std::size_t count, const std::string& what);

/// An angle as it was given: every angle of the command line is a number of radians, taken as the double it is, or of
/// degrees with `deg` behind it, taken exactly as written.
struct Angle {
  Rational exact;
  bool degrees = false;

  /// The nearest double, for labels and pictures.
  double value() const { return exact.to_double(); }
  /// Doubles of radians stay as they are. Degrees, and shares of radians, are reduced to a turn exactly before they are
  /// rounded: quarter turns stay the doubles that stand for them.
  double radians() const;
  /// A fraction of the angle, which is k of n.
  Angle fraction(std::size_t k, std::size_t n) const;
  /// Whether it is a number of whole turns: as degrees exactly, as radians never.
  bool whole_turns() const;
  std::string label() const;  ///< "90°", "1.5 rad"
};

/// Nothing for what is no angle.
std::optional<Angle> angle_in(const std::string& text);

}  // namespace dymsum::cli

// Positions and configurations that questions are asked at, one by one or as a file.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "dymsum/rational.h"
#include "numbers.h"

namespace dymsum::cli {

/// "x,y" or "x,y,theta".
struct QueryLine {
  double x = 0, y = 0;
  std::optional<Angle> theta;
  std::optional<RationalPoint> exact;  ///< where x or y is a fraction; x and y are nearest to it

  RationalPoint at() const { return exact ? *exact : RationalPoint{Rational::of(x).value(), Rational::of(y).value()}; }
};

/// Refused are those that no double is.
enum class Fractions : std::uint8_t { refused, taken };

/// Numbers between commas, or else between blanks; nothing for other text.
std::optional<QueryLine> query_in(const std::string& text, Fractions fractions = Fractions::refused);

/// Ends the command with what is wrong with a line.
using Refuse = std::function<void(const std::string& why)>;

/// Calls `take` with every line of the file, or of standard input for "-", that is not empty, comments left out, and
/// with what refuses that line. Stops with bad input, with file and line, for lines that are no queries, and for a file
/// without any.
void for_each_query(const std::string& file, const std::function<void(const QueryLine&, const Refuse&)>& take,
                    Fractions fractions = Fractions::refused);

}  // namespace dymsum::cli

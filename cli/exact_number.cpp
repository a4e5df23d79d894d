#include "exact_number.h"

#include <ostream>

#include "numbers.h"

namespace dymsum::cli {

std::optional<Rational> exact_number(const std::string& text) {
  if (text.find('/') == std::string::npos) {
    const std::optional<double> number = finite_number(text);
    return number ? std::optional(Rational::of(*number).value()) : std::nullopt;
  }
  const Result<Rational> fraction = Rational::parse(text);
  return fraction ? std::optional(*fraction) : std::nullopt;
}

void print_exact(std::ostream& out, const Rational& value) {
  const double nearest = value.to_double();
  if (const Result<Rational> back = Rational::of(nearest); back && *back == value) out << nearest;
  else out << value.to_string();
}

}  // namespace dymsum::cli

#include "numbers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "dymsum/orientation.h"
#include "exact_number.h"
#include "exit_code.h"

namespace dymsum::cli {

std::optional<double> finite_number(const std::string& text) {
  if (text.empty() || std::isspace(static_cast<unsigned char>(text.front())) != 0) return std::nullopt;
  if (text.find_first_of("xX") != std::string::npos) return std::nullopt;  // hexadecimal
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double length_of(double x, double y, double z) {
  const double most = std::max({std::abs(x), std::abs(y), std::abs(z)});
  if (!(most > 0)) return 0;
  return most * std::sqrt((x / most) * (x / most) + (y / most) * (y / most) + (z / most) * (z / most));
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> pieces;
  std::size_t from = 0;
  for (std::size_t at = text.find(separator); at != std::string::npos; at = text.find(separator, from)) {
    pieces.push_back(text.substr(from, at - from));
    from = at + 1;
  }
  pieces.push_back(text.substr(from));
  return pieces;
}

std::vector<double> numbers_of(const std::string& text, std::size_t count, const std::string& what) {
  std::vector<double> numbers;
  const std::vector<std::string> words = split(text, ',');
  for (const std::string& word : words)
    if (const std::optional<double> number = double_number(word)) numbers.push_back(*number);
  if (numbers.size() != count || words.size() != count)
    throw Stop(kUsage, what + ", not '" + text + "'" + no_double_in(text));
  return numbers;
}

double Angle::radians() const {
  if (degrees) return reduced_degrees(exact);
  const double nearest = exact.to_double();
  return *Rational::of(nearest) == exact ? nearest : reduced_radians(exact);
}

Angle Angle::fraction(std::size_t k, std::size_t n) const {
  return {exact * *Rational::of(static_cast<std::int64_t>(k), static_cast<std::int64_t>(n)), degrees};
}

bool Angle::whole_turns() const { return degrees && (exact / 360).is_integer(); }

std::string Angle::label() const {
  std::ostringstream text;
  text << value() << (degrees ? "°" : " rad");
  return text.str();
}

std::optional<Angle> angle_in(const std::string& text) {
  const bool degrees = text.ends_with("deg");
  const std::optional<double> value = finite_number(degrees ? text.substr(0, text.size() - 3) : text);
  if (!value) return std::nullopt;
  const Result<Rational> written = Rational::parse(degrees ? text.substr(0, text.size() - 3) : "");
  return Angle{written ? *written : *Rational::of(*value), degrees};
}

}  // namespace dymsum::cli

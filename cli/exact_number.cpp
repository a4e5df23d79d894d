#include "exact_number.h"

#include <ostream>
#include <utility>

#include "line_file.h"
#include "numbers.h"

namespace dymsum::cli {
namespace {

bool is_a_double(const Rational& v) {
  const Result<Rational> nearest = Rational::of(v.to_double());
  return nearest && *nearest == v;
}

}  // namespace

std::optional<Rational> exact_number(const std::string& text) {
  if (text.find('/') == std::string::npos) {
    const std::optional<double> number = finite_number(text);
    return number ? std::optional(Rational::of(*number).value()) : std::nullopt;
  }
  const Result<Rational> fraction = Rational::parse(text);
  return fraction ? std::optional(*fraction) : std::nullopt;
}

std::optional<double> double_number(const std::string& text) {
  const std::optional<Rational> number = exact_number(text);
  return number && is_a_double(*number) ? std::optional(number->to_double()) : std::nullopt;
}

std::string no_double_in(const std::string& text) {
  for (const std::string& word : words_of(text)) {
    const std::optional<Rational> number = exact_number(word);
    if (number && !is_a_double(*number)) return "; " + word + " is no double";
  }
  return "";
}

std::optional<std::vector<Rational>> exact_numbers(const std::string& text, std::size_t count) {
  std::vector<Rational> numbers;
  for (const std::string& word : words_of(text)) {
    const std::optional<Rational> number = exact_number(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(std::move(numbers)) : std::nullopt;
}

std::optional<RationalPoint> exact_position(const std::string& text) {
  const auto v = exact_numbers(text, 2);
  return v ? std::optional(RationalPoint{(*v)[0], (*v)[1]}) : std::nullopt;
}

std::optional<RationalPoint3> exact_position_in_space(const std::string& text) {
  const auto v = exact_numbers(text, 3);
  return v ? std::optional(RationalPoint3{(*v)[0], (*v)[1], (*v)[2]}) : std::nullopt;
}

bool is_of_doubles(const RationalPoint& position) { return is_a_double(position.x) && is_a_double(position.y); }
bool is_of_doubles(const RationalPoint3& position) {
  return is_a_double(position.x) && is_a_double(position.y) && is_a_double(position.z);
}

void print_exact(std::ostream& out, const Rational& value) {
  if (is_a_double(value)) out << value.to_double();
  else out << value.to_string();
}

}  // namespace dymsum::cli

#include "digits.h"

#include <nanobind/stl/string.h>

#include <cstdlib>

#include "imported.h"
#include "scalar.h"

namespace dymsum::python {
namespace {

constexpr std::size_t kDigitsAtOnce = 600;

/// 10^n.
nb::object power_of_ten(std::size_t n) {
  return nb::steal(PyNumber_Power(nb::int_(10).ptr(), nb::int_(n).ptr(), Py_None));
}

/// The decimal digits of an integer that is not negative.
std::string digits_of(nb::handle number) {
  const auto bits = nb::cast<std::size_t>(number.attr("bit_length")());
  if (bits < 3 * kDigitsAtOnce) return nb::cast<std::string>(nb::str(number));
  const std::size_t low = bits / 7;  // 3.3 bits a digit: about half of them
  const nb::object parts = checked(PyNumber_Divmod(number.ptr(), power_of_ten(low).ptr()));
  const std::string tail = digits_of(parts[1]);
  return digits_of(parts[0]) + std::string(low - tail.size(), '0') + tail;
}

}  // namespace

nb::object integer_of(std::string_view digits) {
  if (digits.size() <= 18) return nb::int_(std::strtoll(std::string(digits).c_str(), nullptr, 10));
  if (digits.size() <= kDigitsAtOnce) return checked(PyLong_FromString(std::string(digits).c_str(), nullptr, 10));
  const std::size_t low = digits.size() / 2;
  const nb::object high = integer_of(digits.substr(0, digits.size() - low));
  const nb::object moved = checked(PyNumber_Multiply(high.ptr(), power_of_ten(low).ptr()));
  return checked(PyNumber_Add(moved.ptr(), integer_of(digits.substr(digits.size() - low)).ptr()));
}

nb::object signed_integer_of(std::string_view digits) {
  if (!digits.starts_with('-')) return integer_of(digits);
  return checked(PyNumber_Negative(integer_of(digits.substr(1)).ptr()));
}

std::string signed_digits_of(nb::handle number) {
  const nb::object magnitude = checked(PyNumber_Absolute(number.ptr()));
  const int negative = PyObject_RichCompareBool(number.ptr(), magnitude.ptr(), Py_LT);
  if (negative < 0) throw nb::python_error();
  return (negative ? "-" : "") + digits_of(magnitude);
}

}  // namespace dymsum::python

#include "values.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "imported.h"

namespace dymsum::python {
namespace {

/// Python converts no more decimal digits at once than a limit, which programs may set as low as 640.
constexpr std::size_t kDigitsAtOnce = 600;

constinit Imported g_point{"dymsum._values", "Point"}, g_point3{"dymsum._values", "Point3"},
    g_configuration{"dymsum._values", "Configuration"}, g_rational_point{"dymsum._values", "RationalPoint"},
    g_rational_point3{"dymsum._values", "RationalPoint3"}, g_fraction{"fractions", "Fraction"};

PyObject* named_type(std::string_view name) {
  if (name == "Point") return g_point.get().ptr();
  if (name == "Point3") return g_point3.get().ptr();
  if (name == "Configuration") return g_configuration.get().ptr();
  return name == "RationalPoint" ? g_rational_point.get().ptr() : g_rational_point3.get().ptr();
}

/// 10^n.
nb::object power_of_ten(std::size_t n) {
  return nb::steal(PyNumber_Power(nb::int_(10).ptr(), nb::int_(n).ptr(), Py_None));
}

nb::object checked(PyObject* owned) {
  if (!owned) throw nb::python_error();
  return nb::steal(owned);
}

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

/// The decimal digits of an integer that is not negative.
std::string digits_of(nb::handle number) {
  const auto bits = nb::cast<std::size_t>(number.attr("bit_length")());
  if (bits < 3 * kDigitsAtOnce) return nb::cast<std::string>(nb::str(number));
  const std::size_t low = bits / 7;  // 3.3 bits a digit: about half of them
  const nb::object parts = checked(PyNumber_Divmod(number.ptr(), power_of_ten(low).ptr()));
  const std::string tail = digits_of(parts[1]);
  return digits_of(parts[0]) + std::string(low - tail.size(), '0') + tail;
}

std::string signed_digits_of(nb::handle number) {
  const nb::object magnitude = checked(PyNumber_Absolute(number.ptr()));
  const int negative = PyObject_RichCompareBool(number.ptr(), magnitude.ptr(), Py_LT);
  if (negative < 0) throw nb::python_error();
  return (negative ? "-" : "") + digits_of(magnitude);
}

bool is_integer(PyObject* object) { return PyLong_Check(object) || (!PyFloat_Check(object) && PyIndex_Check(object)); }

Result<Rational> ratio_of(nb::handle numerator, nb::handle denominator) {
  int far_n = 0, far_d = 0;
  const long long n = PyLong_AsLongLongAndOverflow(numerator.ptr(), &far_n);
  const long long d = PyLong_AsLongLongAndOverflow(denominator.ptr(), &far_d);
  if (!far_n && !far_d && n != LLONG_MIN && d != LLONG_MIN) return Rational::of(n, d);
  return Rational::parse(signed_digits_of(numerator) + "/" + signed_digits_of(denominator));
}

bool read_number(nb::handle from, Result<Rational>& to) {
  PyObject* const object = from.ptr();
  if (PyFloat_Check(object)) {
    to = Rational::of(PyFloat_AS_DOUBLE(object));
    return true;
  }
  if (is_integer(object)) {
    to = ratio_of(checked(PyNumber_Index(object)), nb::int_(1));
    return true;
  }
  if (PyUnicode_Check(object)) return false;
  if (nb::hasattr(from, "numerator") && nb::hasattr(from, "denominator")) {
    to = ratio_of(checked(PyNumber_Index(from.attr("numerator").ptr())),
                  checked(PyNumber_Index(from.attr("denominator").ptr())));
    return true;
  }
  if (!nb::hasattr(from, "as_integer_ratio")) return false;
  if (!std::isfinite(PyFloat_AsDouble(object))) {  // of numpy's floats and of Decimal
    to = Rational::of(std::nan(""));
    return true;
  }
  const nb::object ratio = from.attr("as_integer_ratio")();
  to = ratio_of(ratio[0], ratio[1]);
  return true;
}

bool read_double(PyObject* object, double& to) {
  if (PyFloat_Check(object)) {
    to = PyFloat_AS_DOUBLE(object);
    return true;
  }
  Result<Rational> exact = Rational();
  if (PyUnicode_Check(object)) return false;
  if (!is_integer(object)) {  // numpy's floats of other widths; no fraction: it would have to be rounded
    if (!nb::hasattr(object, "dtype")) return false;
    to = PyFloat_AsDouble(object);
    if (to == -1 && PyErr_Occurred()) throw nb::python_error();
    return true;
  }
  if (!read_number(object, exact) || !exact) return false;
  to = exact->to_double();
  if (!std::isfinite(to) || !(Rational::of(to).value() == *exact)) {
    throw nb::value_error("an integer coordinate that no double holds");
  }
  return true;
}

template <class Read>
bool read_each(nb::handle from, std::size_t count, Read&& read) noexcept {
  try {
    PyObject* const object = from.ptr();
    if (PyUnicode_Check(object) || !PySequence_Check(object)) return false;
    PyObject* const items = PySequence_Fast(object, "");
    if (!items) throw nb::python_error();
    const nb::object kept = nb::steal(items);
    if (static_cast<std::size_t>(PySequence_Fast_GET_SIZE(items)) != count) return false;
    for (std::size_t k = 0; k < count; ++k) {
      if (!read(PySequence_Fast_ITEMS(items)[k], k)) return false;
    }
    return true;
  } catch (nb::python_error&) {
    return false;
  } catch (std::exception&) {
    return false;
  }
}

PyObject* new_named_of(const char* type, nb::tuple values) {
  const nb::tuple arguments = nb::make_tuple(values);
  return PyTuple_Type.tp_new(reinterpret_cast<PyTypeObject*>(named_type(type)), arguments.ptr(), nullptr);
}

template <class Make>
PyObject* or_exception(Make&& make) noexcept {
  try {
    return make();
  } catch (nb::python_error& error) {
    error.restore();
  } catch (std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  }
  return nullptr;
}

}  // namespace

bool read_doubles(nb::handle from, std::span<double> to) noexcept {
  return read_each(from, to.size(), [&](PyObject* item, std::size_t k) { return read_double(item, to[k]); });
}

bool read_rational(nb::handle from, Rational& to) noexcept {
  try {
    Result<Rational> number = Rational();
    if (!read_number(from, number) || !number) return false;
    to = *number;
    return true;
  } catch (std::exception&) {
    return false;
  }
}

bool read_rationals(nb::handle from, std::span<Rational> to) noexcept {
  return read_each(from, to.size(), [&](PyObject* item, std::size_t k) { return read_rational(item, to[k]); });
}

PyObject* new_fraction(const Rational& value) noexcept {
  return or_exception([&] {
    return g_fraction.get()(signed_integer_of(value.numerator()), integer_of(value.denominator())).release().ptr();
  });
}

PyObject* new_named(const char* type, std::span<const double> values) noexcept {
  return or_exception([&] {
    nb::tuple tuple =
        values.size() == 2 ? nb::make_tuple(values[0], values[1]) : nb::make_tuple(values[0], values[1], values[2]);
    return new_named_of(type, tuple);
  });
}

PyObject* new_named(const char* type, std::span<const Rational> values) noexcept {
  return or_exception([&] {
    nb::tuple tuple =
        values.size() == 2 ? nb::make_tuple(values[0], values[1]) : nb::make_tuple(values[0], values[1], values[2]);
    return new_named_of(type, tuple);
  });
}

}  // namespace dymsum::python

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

/// Null where there is none.
nb::object attribute(nb::handle from, const char* name) {
  PyObject* const found = PyObject_GetAttrString(from.ptr(), name);
  if (found == nullptr && !PyErr_ExceptionMatches(PyExc_AttributeError)) throw nb::python_error();
  if (found == nullptr) PyErr_Clear();
  return nb::steal(found);
}

/// What as_integer_ratio of numpy's floats and of Decimal says; of NaN and infinities, the error.
Result<Rational> ratio_told_by(nb::handle as_integer_ratio) {
  try {
    const nb::object ratio = as_integer_ratio();
    return ratio_of(ratio[0], ratio[1]);
  } catch (const nb::python_error& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_OverflowError)) throw;
    return Rational::of(std::nan(""));
  }
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
  const bool fraction = from.type().is(g_fraction.get());  // its properties are written in Python, which takes longer
  const nb::object numerator = attribute(from, fraction ? "_numerator" : "numerator");
  const nb::object denominator = numerator ? attribute(from, fraction ? "_denominator" : "denominator") : numerator;
  if (denominator) {
    to = ratio_of(checked(PyNumber_Index(numerator.ptr())), checked(PyNumber_Index(denominator.ptr())));
    return true;
  }
  const nb::object as_integer_ratio = attribute(from, "as_integer_ratio");
  if (as_integer_ratio) to = ratio_told_by(as_integer_ratio);
  return as_integer_ratio.is_valid();
}

bool read_double(PyObject* object, double& to) {
  if (PyFloat_Check(object)) {
    to = PyFloat_AS_DOUBLE(object);
    return true;
  }
  Result<Rational> exact = Rational();
  if (PyUnicode_Check(object)) return false;
  if (!is_integer(object)) {  // numpy's floats of other widths; no fraction: it would have to be rounded
    if (!attribute(object, "dtype")) return false;
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
bool read_each(nb::handle from, std::size_t count, Interruption& thrown, Read&& read) noexcept {
  std::size_t k = 0;
  const auto one = [&](nb::handle item) noexcept {
    try {
      return k < count && read(item.ptr(), k++);
    } catch (...) {
      return thrown.keep();
    }
  };
  return each_item(from, thrown, one) && (thrown.kept() || k == count);
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
  Interruption thrown;
  const auto read = [&](PyObject* item, std::size_t k) { return read_double(item, to[k]); };
  return read_each(from, to.size(), thrown, read) && !thrown.kept();
}

bool read_rational(nb::handle from, Result<Rational>& to, Interruption& thrown) noexcept {
  try {
    return read_number(from, to);
  } catch (...) {
    return thrown.keep();
  }
}

bool read_rationals(nb::handle from, std::span<Result<Rational>> to, Interruption& thrown) noexcept {
  return read_each(from, to.size(), thrown, [&](PyObject* item, std::size_t k) { return read_number(item, to[k]); });
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

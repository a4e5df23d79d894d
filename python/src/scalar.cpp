#include "scalar.h"

#include <nanobind/stl/string.h>

#include <climits>
#include <cmath>
#include <string>

#include "digits.h"
#include "errors.h"
#include "imported.h"

namespace dymsum::python {
namespace {

constinit Imported g_exact_class{"fractions", "Fraction"}, g_array{"numpy", "ndarray"},
    g_no_numbers{"dymsum._convert", "NO_NUMBERS"};

bool is_instance(nb::handle object, nb::handle type) {
  const int is_one = PyObject_IsInstance(object.ptr(), type.ptr());
  if (is_one < 0) throw nb::python_error();
  return is_one != 0;
}

/// Null where there is none.
nb::object attribute(nb::handle from, const char* name) {
  PyObject* const found = PyObject_GetAttrString(from.ptr(), name);
  if (found == nullptr && !PyErr_ExceptionMatches(PyExc_AttributeError)) throw nb::python_error();
  if (found == nullptr) PyErr_Clear();
  return nb::steal(found);
}

/// The integer that an object stands for; null for one that says it stands for none, as arrays do.
nb::object index_of(nb::handle from) {
  PyObject* const found = PyNumber_Index(from.ptr());
  if (found == nullptr && !PyErr_ExceptionMatches(PyExc_TypeError)) throw nb::python_error();
  if (found == nullptr) PyErr_Clear();
  return nb::steal(found);
}

Result<Rational> ratio_of(nb::handle numerator, nb::handle denominator) {
  int far_n = 0, far_d = 0;
  const long long n = PyLong_AsLongLongAndOverflow(numerator.ptr(), &far_n);
  const long long d = PyLong_AsLongLongAndOverflow(denominator.ptr(), &far_d);
  if (!far_n && !far_d && n != LLONG_MIN && d != LLONG_MIN) return Rational::of(n, d);
  return Rational::parse(signed_digits_of(numerator) + "/" + signed_digits_of(denominator));
}

double as_float(nb::handle from) {
  const double number = PyFloat_AsDouble(from.ptr());
  if (number == -1 && PyErr_Occurred()) throw nb::python_error();
  return number;
}

/// What as_integer_ratio of numpy's floats and of Decimal says; of NaN and infinities, the error.
Result<Rational> ratio_told_by(nb::handle from, nb::handle as_integer_ratio) {
  try {
    const nb::object ratio = as_integer_ratio();
    return ratio_of(ratio[0], ratio[1]);
  } catch (const nb::python_error& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_OverflowError)) throw;
    const double number = as_float(from);
    if (std::isfinite(number)) throw;
    return Rational::of(number);
  }
}

[[noreturn]] void refuse(nb::handle number) {
  const std::string text = nb::cast<std::string>(nb::str(number));
  throw ErrorRaised({ErrorCode::unsupported_operand, "no double holds the number " + text.substr(0, 60), {}});
}

/// What has nothing but a float, which has to be equal to it.
bool read_float(nb::handle from, Result<Rational>& to) {
  const PyNumberMethods* const methods = Py_TYPE(from.ptr())->tp_as_number;
  if (methods == nullptr || methods->nb_float == nullptr) return false;
  const double number = as_float(from);
  const int same = PyObject_RichCompareBool(from.ptr(), nb::float_(number).ptr(), Py_EQ);
  if (same < 0) throw nb::python_error();
  if (same == 0 && number == number) refuse(from);
  to = Rational::of(number);
  return true;
}

bool read_other(nb::handle from, Result<Rational>& to) {
  if (is_instance(from, g_no_numbers.get())) return false;
  if (is_instance(from, g_array.get())) {
    if (nb::len(nb::object(from.attr("shape"))) != 0) return false;
    return read_rational(from[nb::make_tuple()], to);
  }
  if (PyIndex_Check(from.ptr())) {
    const nb::object number = index_of(from);
    if (number) to = ratio_of(number, nb::int_(1));
    return number.is_valid();
  }
  const nb::object numerator = attribute(from, "numerator");
  const nb::object denominator = numerator ? attribute(from, "denominator") : numerator;
  if (denominator && PyIndex_Check(numerator.ptr()) && PyIndex_Check(denominator.ptr())) {
    to = ratio_of(checked(PyNumber_Index(numerator.ptr())), checked(PyNumber_Index(denominator.ptr())));
    return true;
  }
  const nb::object as_integer_ratio = attribute(from, "as_integer_ratio");
  if (!as_integer_ratio || !PyCallable_Check(as_integer_ratio.ptr())) return read_float(from, to);
  to = ratio_told_by(from, as_integer_ratio);
  return true;
}

/// An integer of Python: the object itself, or what it stands for; null for none.
nb::object whole(nb::handle from, bool convert) {
  if (PyLong_Check(from.ptr())) return nb::borrow(from);
  if (!convert || PyFloat_Check(from.ptr()) || !PyIndex_Check(from.ptr())) return {};
  return index_of(from);
}

}  // namespace

bool read_rational(nb::handle from, Result<Rational>& to) {
  if (PyFloat_Check(from.ptr())) {
    to = Rational::of(PyFloat_AS_DOUBLE(from.ptr()));
    return true;
  }
  if (PyLong_Check(from.ptr())) {
    to = ratio_of(from, nb::int_(1));
    return true;
  }
  if (!from.type().is(g_exact_class.get())) return read_other(from, to);
  to =
      ratio_of(from.attr("_numerator"), from.attr("_denominator"));  // its properties are in Python, which takes longer
  return true;
}

bool read_double(nb::handle from, double& to) {
  if (PyFloat_Check(from.ptr())) {
    to = PyFloat_AS_DOUBLE(from.ptr());
    return true;
  }
  Result<Rational> exact = Rational();
  if (!read_rational(from, exact)) return false;
  if (!exact && exact.error().code != ErrorCode::not_finite) throw ErrorRaised(exact.error());
  to = exact ? exact->to_double() : as_float(from);
  if (exact && (!std::isfinite(to) || !(Rational::of(to).value() == *exact))) refuse(from);
  return true;
}

bool read_signed(nb::handle from, bool convert, long long& to) {
  const nb::object number = whole(from, convert);
  if (!number) return false;
  int far = 0;
  to = PyLong_AsLongLongAndOverflow(number.ptr(), &far);
  return far == 0;
}

bool read_unsigned(nb::handle from, bool convert, unsigned long long& to) {
  const nb::object number = whole(from, convert);
  if (!number) return false;
  to = PyLong_AsUnsignedLongLong(number.ptr());
  if (to != ULLONG_MAX || !PyErr_Occurred()) return true;
  PyErr_Clear();  // negative, or too large
  return false;
}

}  // namespace dymsum::python

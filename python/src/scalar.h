// Every number that comes in, in a signature, a list, a field or a position: taken exactly or refused, by one reader.
#pragma once

#include <nanobind/nanobind.h>

#include <limits>
#include <type_traits>

#include "dymsum/rational.h"
#include "dymsum/result.h"

namespace dymsum::python {

namespace nb = nanobind;

/// Reads an exact number: int, float, Fraction, Decimal, numpy's scalars and arrays without dimensions, and what else
/// has a numerator, an as_integer_ratio or a float that equals it. False for what is no number. NaN and infinities are
/// the error not_finite. What the object itself raises is thrown.
bool read_rational(nb::handle from, Result<Rational>& to);
/// The same as a double. Throws the Error unsupported_operand where no double holds the number; NaN and infinities are
/// read as they are.
bool read_double(nb::handle from, double& to);
/// An integer, of Python or of what stands for one (__index__). False for anything else, and for one that is too large.
bool read_signed(nb::handle from, bool convert, long long& to);
bool read_unsigned(nb::handle from, bool convert, unsigned long long& to);

}  // namespace dymsum::python

namespace nanobind::detail {

/// nanobind's own would round what is no float; where overloads are tried without conversions, only floats are read.
template <>
struct type_caster<double> {
  NB_TYPE_CASTER(double, const_name("float"))
  bool from_python(handle src, uint32_t flags, cleanup_list*) {
    if (!PyFloat_Check(src.ptr())) return (flags & cast_flags::convert) && dymsum::python::read_double(src, value);
    value = PyFloat_AS_DOUBLE(src.ptr());
    return true;
  }
  static handle from_cpp(double number, rv_policy, cleanup_list*) noexcept { return PyFloat_FromDouble(number); }
};

/// nanobind's own would cut off what follows the point of fractions and of numpy's floats.
template <class T>
struct whole_number_caster {
  NB_TYPE_CASTER(T, const_name("int"))
  bool from_python(handle src, uint32_t flags, cleanup_list*) {
    using Widest = std::conditional_t<std::is_signed_v<T>, long long, unsigned long long>;
    Widest read = 0;
    const bool convert = flags & cast_flags::convert;
    if constexpr (std::is_signed_v<T>) {
      if (!dymsum::python::read_signed(src, convert, read)) return false;
    } else {
      if (!dymsum::python::read_unsigned(src, convert, read)) return false;
    }
    if (read < Widest(std::numeric_limits<T>::min()) || read > Widest(std::numeric_limits<T>::max())) return false;
    value = static_cast<T>(read);
    return true;
  }
  static handle from_cpp(T number, rv_policy, cleanup_list*) noexcept {
    if constexpr (std::is_signed_v<T>) return PyLong_FromLongLong(number);
    return PyLong_FromUnsignedLongLong(static_cast<unsigned long long>(number));
  }
};

#define DYMSUM_WHOLE_NUMBER(TYPE) \
  template <>                     \
  struct type_caster<TYPE> : whole_number_caster<TYPE> {};
DYMSUM_WHOLE_NUMBER(signed char)
DYMSUM_WHOLE_NUMBER(unsigned char)
DYMSUM_WHOLE_NUMBER(short)
DYMSUM_WHOLE_NUMBER(unsigned short)
DYMSUM_WHOLE_NUMBER(int)
DYMSUM_WHOLE_NUMBER(unsigned int)
DYMSUM_WHOLE_NUMBER(long)
DYMSUM_WHOLE_NUMBER(unsigned long)
DYMSUM_WHOLE_NUMBER(long long)
DYMSUM_WHOLE_NUMBER(unsigned long long)
#undef DYMSUM_WHOLE_NUMBER

}  // namespace nanobind::detail

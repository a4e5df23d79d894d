// Numbers and positions: Rational is fractions.Fraction; points and configurations are named tuples, and any sequence
// of numbers is taken for one.
#pragma once

#include <nanobind/nanobind.h>

#include <span>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/mesh.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "errors.h"

namespace dymsum::python {

/// Reads `to.size()` doubles from a sequence of so many numbers. An integer has to be a double. False, without an
/// exception set, for anything else.
bool read_doubles(nb::handle from, std::span<double> to) noexcept;
/// Reads exact numbers: int, float, Fraction, Decimal, numpy's. False, without an exception, for anything else, and for
/// NaN and infinities.
bool read_rational(nb::handle from, Rational& to) noexcept;
bool read_rationals(nb::handle from, std::span<Rational> to) noexcept;

/// New references; null with an exception set.
PyObject* new_fraction(const Rational& value) noexcept;
PyObject* new_named(const char* type, std::span<const double> values) noexcept;
PyObject* new_named(const char* type, std::span<const Rational> values) noexcept;

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::Rational> {
  NB_TYPE_CASTER(dymsum::Rational, io_name("fractions.Fraction | float", "fractions.Fraction"))
  bool from_python(handle src, uint32_t, cleanup_list*) noexcept { return dymsum::python::read_rational(src, value); }
  static handle from_cpp(const dymsum::Rational& number, rv_policy, cleanup_list*) noexcept {
    return dymsum::python::new_fraction(number);
  }
};

/// A struct of doubles as a named tuple.
#define DYMSUM_NAMED_DOUBLES(TYPE, COUNT, ...)                                                         \
  template <>                                                                                          \
  struct type_caster<dymsum::TYPE> {                                                                   \
    NB_TYPE_CASTER(dymsum::TYPE, io_name("numpy.typing.ArrayLike", "dymsum." #TYPE))                   \
    bool from_python(handle src, uint32_t, cleanup_list*) noexcept {                                   \
      double v[COUNT];                                                                                 \
      if (!dymsum::python::read_doubles(src, v)) return false;                                         \
      value = {v[0], v[1] __VA_ARGS__};                                                                \
      return true;                                                                                     \
    }                                                                                                  \
    static handle from_cpp(const dymsum::TYPE& of, rv_policy, cleanup_list*) noexcept {                \
      static_assert(sizeof(of) == COUNT * sizeof(double));                                             \
      return dymsum::python::new_named(#TYPE, std::span(reinterpret_cast<const double*>(&of), COUNT)); \
    }                                                                                                  \
  };
#define DYMSUM_COMMA ,
DYMSUM_NAMED_DOUBLES(Point, 2)
DYMSUM_NAMED_DOUBLES(Point3, 3, DYMSUM_COMMA v[2])
DYMSUM_NAMED_DOUBLES(Configuration, 3, DYMSUM_COMMA v[2])
#undef DYMSUM_COMMA
#undef DYMSUM_NAMED_DOUBLES

template <>
struct type_caster<dymsum::RationalPoint> {
  NB_TYPE_CASTER(dymsum::RationalPoint,
                 io_name("collections.abc.Sequence[fractions.Fraction | float]", "dymsum.RationalPoint"))
  bool from_python(handle src, uint32_t, cleanup_list*) noexcept {
    dymsum::Rational v[2];
    if (!dymsum::python::read_rationals(src, v)) return false;
    value = {v[0], v[1]};
    return true;
  }
  static handle from_cpp(const dymsum::RationalPoint& p, rv_policy, cleanup_list*) noexcept {
    const dymsum::Rational values[] = {p.x, p.y};
    return dymsum::python::new_named("RationalPoint", values);
  }
};

template <>
struct type_caster<dymsum::RationalPoint3> {
  NB_TYPE_CASTER(dymsum::RationalPoint3,
                 io_name("collections.abc.Sequence[fractions.Fraction | float]", "dymsum.RationalPoint3"))
  bool from_python(handle src, uint32_t, cleanup_list*) noexcept {
    dymsum::Rational v[3];
    if (!dymsum::python::read_rationals(src, v)) return false;
    value = {v[0], v[1], v[2]};
    return true;
  }
  static handle from_cpp(const dymsum::RationalPoint3& p, rv_policy, cleanup_list*) noexcept {
    const dymsum::Rational values[] = {p.x, p.y, p.z};
    return dymsum::python::new_named("RationalPoint3", values);
  }
};

}  // namespace nanobind::detail

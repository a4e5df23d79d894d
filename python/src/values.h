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
/// Reads exact numbers: int, float, Fraction, Decimal, numpy's. False, without an exception, for anything else; NaN and
/// infinities are not_finite.
bool read_rational(nb::handle from, Result<Rational>& to) noexcept;
bool read_rationals(nb::handle from, std::span<Result<Rational>> to) noexcept;

/// New references; null with an exception set.
PyObject* new_fraction(const Rational& value) noexcept;
PyObject* new_named(const char* type, std::span<const double> values) noexcept;
PyObject* new_named(const char* type, std::span<const Rational> values) noexcept;

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::Rational> {
  static constexpr auto Name = io_name("fractions.Fraction | float", "fractions.Fraction");
  using Value = dymsum::Rational;
  template <typename T>
  using Cast = Value;
  template <typename T>
  bool can_cast() const {
    return true;
  }
  bool from_python(handle src, uint32_t, cleanup_list*) noexcept { return dymsum::python::read_rational(src, value); }
  static handle from_cpp(const Value& number, rv_policy, cleanup_list*) noexcept {
    return dymsum::python::new_fraction(number);
  }
  static handle from_cpp(const Value* number, rv_policy policy, cleanup_list* list) noexcept {
    return number ? from_cpp(*number, policy, list) : none().release();
  }
  explicit operator Value() { return dymsum::python::take(dymsum::Result<Value>(value)); }
  dymsum::Result<Value> value = Value();
};

/// A struct of doubles as a named tuple.
#define DYMSUM_NAMED_DOUBLES(TYPE, COUNT, ...)                                                         \
  template <>                                                                                          \
  struct type_caster<dymsum::TYPE> {                                                                   \
    NB_TYPE_CASTER(dymsum::TYPE, io_name("numpy.typing.ArrayLike", "dymsum." #TYPE))           \
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

template <class T, int N>
struct named_rationals_caster {
  using Value = T;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  bool from_python(handle src, uint32_t, cleanup_list*) noexcept { return dymsum::python::read_rationals(src, value); }
  explicit operator Value() {
    dymsum::Rational v[N];
    for (int k = 0; k < N; ++k) v[k] = dymsum::python::take(dymsum::Result<dymsum::Rational>(value[k]));
    if constexpr (N == 2) {
      return {v[0], v[1]};
    } else {
      return {v[0], v[1], v[2]};
    }
  }
  std::array<dymsum::Result<dymsum::Rational>, N> value = filled(std::make_index_sequence<N>());

 private:
  template <std::size_t... K>
  static std::array<dymsum::Result<dymsum::Rational>, N> filled(std::index_sequence<K...>) {
    return {((void)K, dymsum::Result<dymsum::Rational>(dymsum::Rational()))...};
  }
};

template <>
struct type_caster<dymsum::RationalPoint> : named_rationals_caster<dymsum::RationalPoint, 2> {
  static constexpr auto Name =
      io_name("collections.abc.Sequence[fractions.Fraction | float]", "dymsum.RationalPoint");
  static handle from_cpp(const dymsum::RationalPoint& p, rv_policy, cleanup_list*) noexcept {
    const dymsum::Rational values[] = {p.x, p.y};
    return dymsum::python::new_named("RationalPoint", values);
  }
};

template <>
struct type_caster<dymsum::RationalPoint3> : named_rationals_caster<dymsum::RationalPoint3, 3> {
  static constexpr auto Name =
      io_name("collections.abc.Sequence[fractions.Fraction | float]", "dymsum.RationalPoint3");
  static handle from_cpp(const dymsum::RationalPoint3& p, rv_policy, cleanup_list*) noexcept {
    const dymsum::Rational values[] = {p.x, p.y, p.z};
    return dymsum::python::new_named("RationalPoint3", values);
  }
};

}  // namespace nanobind::detail

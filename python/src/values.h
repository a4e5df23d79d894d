// Numbers and positions: Rational is fractions.Fraction; points and configurations are named tuples, and any sequence
// of numbers is taken for one.
#pragma once

#include <nanobind/nanobind.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/mesh.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "errors.h"
#include "lists.h"

namespace dymsum::python {

/// Reads `to.size()` numbers from a sequence of so many, as read_double and read_rational do. False for anything else.
bool read_doubles(nb::handle from, std::span<double> to);
bool read_rationals(nb::handle from, std::span<Result<Rational>> to);
/// (x, y, theta): the position as read_rational, the angle as read_double.
bool read_configuration(nb::handle from, std::span<Result<Rational>, 2> position, double& theta);

inline double in_degrees(double radians) { return radians * 57.295779513082320877; }

/// New references; null with an exception set.
PyObject* new_fraction(const Rational& value) noexcept;
PyObject* new_named(const char* type, std::span<const double> values) noexcept;
PyObject* new_named(const char* type, std::span<const Rational> values) noexcept;

}  // namespace dymsum::python

namespace nanobind::detail {

/// What is requested throws what is wrong with the numbers.
template <class T, std::size_t K>
struct rational_caster {
  using Value = T;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  /// Whether what was read is finite: false where one of the numbers is NaN or infinite.
  bool is_finite() const {
    return std::none_of(numbers_.begin(), numbers_.end(), [](const dymsum::Result<dymsum::Rational>& number) {
      return !number && number.error().code == dymsum::ErrorCode::not_finite;
    });
  }

 protected:
  template <std::size_t N>
  dymsum::Rational take() {
    return dymsum::python::take(std::move(numbers_[N]));
  }
  std::array<dymsum::Result<dymsum::Rational>, K> numbers_ = filled(std::make_index_sequence<K>());

 private:
  template <std::size_t... N>
  static std::array<dymsum::Result<dymsum::Rational>, K> filled(std::index_sequence<N...>) {
    return {((void)N, dymsum::Rational())...};
  }
};

template <>
struct type_caster<dymsum::Rational> : rational_caster<dymsum::Rational, 1> {
  static constexpr auto Name = io_name("fractions.Fraction | float", "fractions.Fraction");
  bool from_python(handle src, uint32_t, cleanup_list*) { return dymsum::python::read_rational(src, numbers_[0]); }
  explicit operator Value() { return take<0>(); }
  static handle from_cpp(const dymsum::Rational& number, rv_policy, cleanup_list*) noexcept {
    return dymsum::python::new_fraction(number);
  }
};

/// A struct of doubles as a named tuple.
#define DYMSUM_NAMED_DOUBLES(TYPE, COUNT, ...)                                                         \
  template <>                                                                                          \
  struct type_caster<dymsum::TYPE> {                                                                   \
    NB_TYPE_CASTER(dymsum::TYPE, io_name("numpy.typing.ArrayLike", "dymsum." #TYPE))                   \
    bool from_python(handle src, uint32_t, cleanup_list*) {                                            \
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
struct type_caster<dymsum::RationalPoint> : rational_caster<dymsum::RationalPoint, 2> {
  static constexpr auto Name = io_name("collections.abc.Sequence[fractions.Fraction | float]", "dymsum.RationalPoint");
  bool from_python(handle src, uint32_t, cleanup_list*) { return dymsum::python::read_rationals(src, numbers_); }
  explicit operator Value() { return {take<0>(), take<1>()}; }
  static handle from_cpp(const dymsum::RationalPoint& p, rv_policy, cleanup_list*) noexcept {
    const dymsum::Rational values[] = {p.x, p.y};
    return dymsum::python::new_named("RationalPoint", values);
  }
};

template <>
struct type_caster<dymsum::RationalPoint3> : rational_caster<dymsum::RationalPoint3, 3> {
  static constexpr auto Name = io_name("collections.abc.Sequence[fractions.Fraction | float]", "dymsum.RationalPoint3");
  bool from_python(handle src, uint32_t, cleanup_list*) { return dymsum::python::read_rationals(src, numbers_); }
  explicit operator Value() { return {take<0>(), take<1>(), take<2>()}; }
  static handle from_cpp(const dymsum::RationalPoint3& p, rv_policy, cleanup_list*) noexcept {
    const dymsum::Rational values[] = {p.x, p.y, p.z};
    return dymsum::python::new_named("RationalPoint3", values);
  }
};

}  // namespace nanobind::detail

#include "values.h"

#include <string_view>

#include "digits.h"
#include "imported.h"

namespace dymsum::python {
namespace {

constinit Imported g_point{"dymsum._values", "Point"}, g_point3{"dymsum._values", "Point3"},
    g_configuration{"dymsum._values", "Configuration"}, g_rational_point{"dymsum._values", "RationalPoint"},
    g_rational_point3{"dymsum._values", "RationalPoint3"}, g_fraction{"fractions", "Fraction"};

PyObject* named_type(std::string_view name) {
  if (name == "Point") return g_point.get().ptr();
  if (name == "Point3") return g_point3.get().ptr();
  if (name == "Configuration") return g_configuration.get().ptr();
  return name == "RationalPoint" ? g_rational_point.get().ptr() : g_rational_point3.get().ptr();
}

/// read(item, its index) for every item of a sequence of `count`; false for another.
template <class Read>
bool read_each(nb::handle from, std::size_t count, Read&& read) {
  std::size_t k = 0;
  return each_item(from, [&](nb::handle item) { return k < count && read(item, k++); }) && k == count;
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

bool read_doubles(nb::handle from, std::span<double> to) {
  return read_each(from, to.size(), [&](nb::handle item, std::size_t k) { return read_double(item, to[k]); });
}

bool read_rationals(nb::handle from, std::span<Result<Rational>> to) {
  return read_each(from, to.size(), [&](nb::handle item, std::size_t k) { return read_rational(item, to[k]); });
}

bool read_configuration(nb::handle from, std::span<Result<Rational>, 2> position, double& theta) {
  return read_each(from, 3, [&](nb::handle item, std::size_t k) {
    return k < 2 ? read_rational(item, position[k]) : read_double(item, theta);
  });
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

// Errors of the library as Python's exception dymsum.Error.
#pragma once

#include <nanobind/nanobind.h>

#include <exception>
#include <utility>

#include "dymsum/result.h"
#include "interruption.h"

namespace dymsum::python {

namespace nb = nanobind;

/// Carries an Error through C++ to where nanobind turns exceptions into Python's.
struct ErrorRaised : std::exception {
  explicit ErrorRaised(Error what) : error(std::move(what)) {}
  const char* what() const noexcept override { return "dymsum::Error"; }
  Error error;
};

/// The value of a result, or its error as an exception.
template <class T>
T take(Result<T>&& result) {
  if (!result.ok()) throw ErrorRaised(result.error());
  return std::move(result).value();
}
inline void take(Result<void>&& result) {
  if (!result.ok()) throw ErrorRaised(result.error());
}

/// An instance of dymsum.Error, not raised.
nb::object error_object(const Error& error);
/// The Error of an instance of dymsum.Error. Requires the GIL.
Error error_of(nb::handle object);

void bind_errors(nb::module_& m);

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::Error> {
  NB_TYPE_CASTER(dymsum::Error, const_name("dymsum.Error"))
  bool from_python(handle src, uint32_t, cleanup_list*) noexcept {
    dymsum::python::Interruption thrown;
    try {
      value = dymsum::python::error_of(src);
      return true;
    } catch (...) {
      thrown.keep();
      return false;
    }
  }
  static handle from_cpp(const dymsum::Error& error, rv_policy, cleanup_list*) noexcept {
    try {
      return dymsum::python::error_object(error).release();
    } catch (python_error& e) {
      e.restore();
      return {};
    }
  }
};

}  // namespace nanobind::detail

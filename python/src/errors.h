// Errors of the library as Python's exception dymsum.Error.
#pragma once

#include <nanobind/nanobind.h>

#include <exception>
#include <optional>
#include <utility>

#include "dymsum/result.h"
#include "scalar.h"

namespace dymsum::python {

namespace nb = nanobind;

/// Carries an Error through C++ to where nanobind turns exceptions into Python's. `item` is the index of what failed in
/// a list that a call was given.
struct ErrorRaised : std::exception {
  explicit ErrorRaised(Error what) : error(std::move(what)) {}
  const char* what() const noexcept override { return "dymsum::Error"; }
  Error error;
  std::optional<std::size_t> item;
};

/// Sets `item` of a dymsum.Error that has none.
void name_item(const nb::python_error& raised, std::size_t item);

/// The value of a result, or its error as an exception.
template <class T>
T take(Result<T>&& result) {
  if (!result.ok()) throw ErrorRaised(result.error());
  return std::move(result).value();
}
inline void take(Result<void>&& result) {
  if (!result.ok()) throw ErrorRaised(result.error());
}

/// make(); an Error that it raises, in C++ or in Python, names the item. With the GIL.
template <class Make>
auto of_item(std::size_t item, Make&& make) {
  try {
    return make();
  } catch (ErrorRaised& raised) {
    if (!raised.item) raised.item = item;
    throw;
  } catch (nb::python_error& raised) {
    name_item(raised, item);
    throw;
  }
}

/// An instance of dymsum.Error, not raised.
nb::object error_object(const Error& error);
/// Whether the object is an instance of dymsum.Error.
bool is_error(nb::handle object);
/// The Error of an instance of dymsum.Error. Requires the GIL.
Error error_of(nb::handle object);

void bind_errors(nb::module_& m);

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::Error> {
  NB_TYPE_CASTER(dymsum::Error, const_name("dymsum.Error"))
  bool from_python(handle src, uint32_t, cleanup_list*) {
    if (!dymsum::python::is_error(src)) return false;
    value = dymsum::python::error_of(src);
    return true;
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

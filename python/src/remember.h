// How a result was made, kept with it so that it can be pickled: made again, from operands and options.
#pragma once

#include <nanobind/nanobind.h>

#include <utility>

namespace dymsum::python {

namespace nb = nanobind;

/// `result` as a Python object that pickles as a call of dymsum._remake's `function` with these arguments.
template <class T, class... Arguments>
nb::object remembered(T&& result, const char* function, Arguments&&... arguments) {
  nb::object object = nb::cast(std::forward<T>(result));
  object.attr("_made_by") = nb::make_tuple(function, nb::make_tuple(std::forward<Arguments>(arguments)...));
  return object;
}

/// __reduce__ of a class whose objects are remembered. Raises TypeError for one that is not.
nb::object made_again(nb::handle object);

}  // namespace dymsum::python

// How a result was made, kept with it so that it can be pickled: made again, from operands and options.
#pragma once

#include <nanobind/nanobind.h>

#include <type_traits>
#include <utility>

#include "dymsum/planar_sum.h"

namespace dymsum::python {

namespace nb = nanobind;

/// A T as a Python object.
template <class T>
struct Remembered {
  nb::object object;
};

void remember(nb::handle object, const char* function, nb::tuple arguments);

/// Options to be remembered: None for those by default, which costs no object.
nb::object kept(const SumOptions& options);

/// What is remembered of an argument: of options no progress, which would be kept alive.
template <class T>
auto without_progress(T&& argument) {
  std::remove_cvref_t<T> own = std::forward<T>(argument);
  if constexpr (requires { own.progress = Progress(); }) own.progress = {};
  return own;
}

/// `result` as a Python object that pickles as a call of dymsum._remake's `function` with these arguments.
template <class T, class... Arguments>
Remembered<std::remove_cvref_t<T>> remembered(T&& result, const char* function, Arguments&&... arguments) {
  nb::object object = nb::cast(std::forward<T>(result));
  remember(object, function, nb::make_tuple(without_progress(std::forward<Arguments>(arguments))...));
  return {std::move(object)};
}

/// __reduce__ of a class whose objects are remembered. Raises TypeError for one that is not.
nb::object made_again(nb::handle object);

}  // namespace dymsum::python

namespace nanobind::detail {

/// Its type in signatures is T.
template <class T>
struct type_caster<dymsum::python::Remembered<T>> {
  using Value = dymsum::python::Remembered<T>;
  static constexpr auto Name = make_caster<T>::Name;
  static handle from_cpp(const Value& of, rv_policy, cleanup_list*) noexcept { return handle(of.object).inc_ref(); }
};

}  // namespace nanobind::detail

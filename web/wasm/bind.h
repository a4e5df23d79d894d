// How functions are bound: errors of the library become values that the JavaScript side throws as DymsumError.
#pragma once

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "dymsum/result.h"

namespace dymsum::web {

using emscripten::val;

/// An Error on its way out of a bound function.
struct Thrown {
  Error error;
};

/// The value, or the error thrown.
template <class T>
T got(Result<T> result) {
  if (!result) throw Thrown{result.error()};
  return std::move(result).value();
}
inline void got(const Result<void>& result) {
  if (!result) throw Thrown{result.error()};
}

/// Handles share what they hold, so that JavaScript may dispose of any of them at any time.
template <class T>
std::shared_ptr<T> shared(T value) {
  return std::make_shared<T>(std::move(value));
}

/// {code, reason, message, evidence}
val error_data(const Error& error);
/// What the JavaScript side recognises: an instance of its class Failure.
val failure(const Error& error);
/// The exception that is being handled, which must be none of JavaScript's.
val failure_of_current();

template <class T>
val to_val(T&& value) {
  if constexpr (std::is_same_v<std::decay_t<T>, val>) return std::forward<T>(value);
  else return val(std::forward<T>(value));
}

template <auto function>
struct Guarded;
template <class R, class... A, R (*function)(A...)>
struct Guarded<function> {
  static val call(A... args) {
    try {
      if constexpr (std::is_void_v<R>) {
        function(std::forward<A>(args)...);
        return val::undefined();
      } else {
        return to_val(function(std::forward<A>(args)...));
      }
    } catch (const Thrown& thrown) {
      return failure(thrown.error);
    } catch (const std::exception&) {
      return failure_of_current();
    }
  }
};
/// `function` as embind takes it.
template <auto function>
constexpr auto guarded = &Guarded<function>::call;

/// A class that JavaScript holds by handles.
template <class T>
emscripten::class_<T> handle(const char* name) {
  emscripten::class_<T> bound(name);
  bound.template smart_ptr<std::shared_ptr<T>>((std::string(name) + "Handle").c_str());
  return bound;
}

}  // namespace dymsum::web

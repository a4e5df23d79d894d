// Values of the library as plain data of JavaScript.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>

#include "arrays.h"
#include "dymsum/fields.h"

namespace dymsum::web {

/// As JavaScript names fields: "at_low" is atLow.
std::string camel_case(std::string_view name);

/// What a record of type T has besides its fields.
template <class T>
struct Derived {
  static void add(val&, const T&) {}
};

/// Numbers, texts, names of enumerators, exact numbers as texts, null for what is not there, lists, and records by
/// their fields.
template <class T>
val plain(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return val(value);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return val(static_cast<double>(value));
  } else if constexpr (std::is_enum_v<T>) {
    return val(std::string(name(value)));
  } else if constexpr (std::is_convertible_v<T, std::string_view>) {
    return val(std::string(value));
  } else if constexpr (std::is_same_v<T, Rational>) {
    return val(value.to_string());
  } else if constexpr (names::kIsOptional<T>) {
    return value ? plain(*value) : val::null();
  } else if constexpr (names::kIsList<T>) {
    return list_of(value, [](const auto& item) { return plain(item); });
  } else {
    val made = val::object();
    names::for_each_field(value,
                          [&](std::string_view name, const auto& field) { made.set(camel_case(name), plain(field)); });
    Derived<T>::add(made, value);
    return made;
  }
}

}  // namespace dymsum::web

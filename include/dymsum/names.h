// Enumerators by name. Their declaration is their only list: the names are what the compiler calls them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace dymsum {
namespace names {

/// A scoped enumeration. Its enumerators are 0, 1, 2, ..., at most 64: the declaration gives no values.
template <class E>
concept Enumeration = std::is_enum_v<E> && !std::is_convertible_v<E, std::underlying_type_t<E>>;

/// "apart" of Meeting::apart; "" of a value without an enumerator, which compilers write as "(dymsum::Meeting)3".
template <auto value>
consteval std::string_view written() {
  constexpr std::string_view kBefore = "value = ";
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_prefix(text.find(kBefore) + kBefore.size());
  text = text.substr(0, text.find_first_of(";]"));
  return text.front() == '(' ? std::string_view() : text.substr(text.rfind(':') + 1);
}

template <Enumeration E>
consteval std::size_t count() {
  return []<std::size_t... k>(std::index_sequence<k...>) {
    std::size_t n = 0;
    static_cast<void>(((!written<static_cast<E>(k)>().empty() && ++n > 0) && ...));
    return n;
  }
  (std::make_index_sequence<65>());
}

template <Enumeration E>
inline constexpr auto kAll = []<std::size_t... k>(std::index_sequence<k...>) {
  return std::array<std::string_view, sizeof...(k)>{written<static_cast<E>(k)>()...};
}
(std::make_index_sequence<count<E>()>());

}  // namespace names

/// The names of an enumeration as code, JSON, Python and JavaScript write them, in the order of its values.
template <names::Enumeration E>
constexpr const auto& names_of() {
  return names::kAll<E>;
}

/// The name of an enumerator. Requires: one of the declared ones.
template <names::Enumeration E>
constexpr std::string_view name(E value) {
  const auto at = static_cast<std::size_t>(value);
  if (at >= names_of<E>().size()) throw std::invalid_argument("name: not an enumerator");
  return names_of<E>()[at];
}

/// The enumerator of this name.
template <names::Enumeration E>
constexpr std::optional<E> parse(std::string_view text) {
  for (std::size_t k = 0; k < names_of<E>().size(); ++k)
    if (names_of<E>()[k] == text) return static_cast<E>(k);
  return std::nullopt;
}

}  // namespace dymsum

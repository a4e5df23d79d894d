// What a list of a record's fields is made of. The lists are in fields.h, which is what to include.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "dymsum/names.h"

namespace dymsum {
namespace names {

/// A member of a record, by the name that its declaration gives it.
template <auto pointer>
struct Field {
  static constexpr auto kMember = pointer;
  static constexpr std::string_view kName = written<pointer>();
  const char* about = "";  ///< what the declaration does not say, for Python's help
};

template <auto... pointers>
inline constexpr std::tuple<Field<pointers>...> kMembers{};

struct Unlisted {};
/// The fields of a record in their order: those that Python, JavaScript and reports have.
template <class Record>
inline constexpr Unlisted kFields{};

template <class Record>
concept Listed = !std::is_same_v<std::remove_cvref_t<decltype(kFields<Record>)>, Unlisted>;

/// Whether a field may be empty, and whether it is a list: for what writes all kinds of fields.
template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsList = false;
template <class T>
inline constexpr bool kIsList<std::vector<T>> = true;
template <class T, std::size_t n>
inline constexpr bool kIsList<std::array<T, n>> = true;

/// Calls `use(name, value)` for every field of a record, which may be one to be filled.
template <class Record, class Use>
requires Listed<std::remove_const_t<Record>>
void for_each_field(Record& record, Use use) {
  const auto one = [&]<auto pointer>(const Field<pointer>& field) { use(field.kName, record.*pointer); };
  std::apply([&](const auto&... fields) { (one(fields), ...); }, kFields<std::remove_const_t<Record>>);
}

}  // namespace names
}  // namespace dymsum

// Records of the library as JSON, by the list of their fields.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "dymsum/fields.h"
#include "json_report.h"

namespace dymsum::cli {

/// Positions are lists of their coordinates.
template <class T>
inline constexpr bool kIsPosition = std::is_same_v<T, Point> || std::is_same_v<T, RationalPoint>;

/// Exact numbers are texts, enumerators their names, and null is what is not there.
template <class T>
Json json_of(const T& value) {
  if constexpr (std::is_same_v<T, Rational>) {
    return value.to_string();
  } else if constexpr (std::is_enum_v<T>) {
    return name(value);
  } else if constexpr (names::kIsOptional<T>) {
    return value ? json_of(*value) : Json(nullptr);
  } else if constexpr (names::kIsList<T>) {
    Json list = Json::array();
    for (const auto& item : value) list.push_back(json_of(item));
    return list;
  } else if constexpr (names::Listed<T>) {
    Json json = kIsPosition<T> ? Json::array() : Json::object();
    names::for_each_field(value, [&](std::string_view name, const auto& field) {
      if constexpr (kIsPosition<T>) json.push_back(json_of(field));
      else json[std::string(name)] = json_of(field);
    });
    return json;
  } else {
    return value;
  }
}

/// A record without these fields.
template <names::Listed T>
Json json_without(const T& record, const std::vector<std::string>& fields) {
  Json json = json_of(record);
  for (const std::string& field : fields) json.erase(field);
  return json;
}

}  // namespace dymsum::cli

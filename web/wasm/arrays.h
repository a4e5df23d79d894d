// Typed arrays: copies of the library's numbers, and numbers from JavaScript.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "bind.h"
#include "dymsum/mesh.h"
#include "dymsum/region.h"

namespace dymsum::web {

/// A Float64Array, Uint32Array, Uint8Array, ... of its own.
template <class T>
val array_of(const std::vector<T>& numbers) {
  return val(emscripten::typed_memory_view(numbers.size(), numbers.data())).template call<val>("slice");
}
inline val bytes_of(std::string_view text) {
  return val(emscripten::typed_memory_view(text.size(), reinterpret_cast<const std::uint8_t*>(text.data())))
      .call<val>("slice");
}

/// A JavaScript array of what `made` makes of each.
template <class Range, class Make>
val list_of(const Range& range, Make made) {
  val list = val::array();
  for (const auto& item : range) list.call<void>("push", made(item));
  return list;
}

/// Float64Array, array of numbers or array of arrays of numbers.
std::vector<double> numbers_in(const val& array);
/// An index or a count as JavaScript gives it, where embind would wrap what is too large and cut what is no integer.
/// Error bad_index.
std::uint32_t index_in(double number);
std::vector<std::uint32_t> indices_in(const val& array);
/// A position of finite coordinates. Error not_finite.
void check_finite(std::initializer_list<double> coordinates);
/// The number of bits that an exact answer may have; a mebibit where nothing is told.
std::size_t bits_in(const val& bits);
/// Two numbers each. Error malformed where there is half of one.
Ring points_in(const val& coordinates);

inline void add(std::vector<double>& numbers, Point at) { numbers.insert(numbers.end(), {at.x, at.y}); }
inline void add(std::vector<double>& numbers, const Point3& at) { numbers.insert(numbers.end(), {at.x, at.y, at.z}); }

Point point_in(const val& at);
Point3 point3_in(const val& at);

}  // namespace dymsum::web

// Lists, arrays of the standard library and optional values. Readers of this package throw what is wrong with an
// object, and what it raises itself, from where they read it; nanobind's own containers may not throw there.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "imported.h"
#include "scalar.h"

namespace dymsum::python {

/// Whether the object is a sequence, no text, and `read` is true for every item; requests signals meanwhile. How many
/// there are is found by iterating: what an object says of its length is not believed. Throws what is raised.
template <class Read>
bool each_item(nb::handle object, Read&& read) {
  constexpr std::size_t kBetween = 1024;
  if (PyUnicode_Check(object.ptr()) || !PySequence_Check(object.ptr())) return false;
  const nb::object iterator = checked(PyObject_GetIter(object.ptr()));
  for (std::size_t k = 1;; ++k) {
    const nb::object item = nb::steal(PyIter_Next(iterator.ptr()));
    if (!item && PyErr_Occurred()) throw nb::python_error();
    if (!item) return true;
    if (k % kBetween == 0 && PyErr_CheckSignals() != 0) throw nb::python_error();
    if (!read(nb::handle(item))) return false;
  }
}

}  // namespace dymsum::python

namespace nanobind::detail {

/// What the casters below share.
template <class T>
struct list_reader {
  using Value = T;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  explicit operator Value() { return std::move(value_); }

 protected:
  /// to(what the item is).
  template <class Item, class To>
  static bool read(handle src, uint32_t flags, cleanup_list* list, To&& to) {
    make_caster<Item> item;
    if (!item.from_python(src, flags_for_local_caster<Item>(flags), list) || !item.template can_cast<Item>()) {
      return false;
    }
    to(item.operator cast_t<Item>());
    return true;
  }
  Value value_;
};

template <class T>
struct type_caster<std::vector<T>> : list_reader<std::vector<T>> {
  static constexpr auto Name =
      io_name("collections.abc.Sequence", "list") + const_name("[") + make_caster<T>::Name + const_name("]");
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    this->value_.clear();
    const auto add = [&](auto&& one) { this->value_.push_back(std::forward<decltype(one)>(one)); };
    return dymsum::python::each_item(src, [&](handle item) { return this->template read<T>(item, flags, list, add); });
  }
  template <class V>
  static handle from_cpp(V&& of, rv_policy policy, cleanup_list* list) noexcept {
    return list_caster<std::vector<T>, T>::from_cpp(std::forward<V>(of), policy, list);
  }
};

template <class T, std::size_t N>
requires(N > 0) struct type_caster<std::array<T, N>> : list_reader<std::array<T, N>> {
  static constexpr auto Name = type_caster<std::vector<T>>::Name;
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    std::size_t k = 0;
    const auto set = [&](auto&& one) { this->value_[k++] = std::forward<decltype(one)>(one); };
    const auto add = [&](handle item) { return k < N && this->template read<T>(item, flags, list, set); };
    return dymsum::python::each_item(src, add) && k == N;
  }
  template <class V>
  static handle from_cpp(V&& of, rv_policy policy, cleanup_list* list) noexcept {
    return array_caster<std::array<T, N>, T, N>::from_cpp(std::forward<V>(of), policy, list);
  }
};

template <class T>
requires(sizeof(T) > 0) struct type_caster<std::optional<T>> : list_reader<std::optional<T>> {
  static constexpr auto Name = optional_caster<std::optional<T>>::Name;
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    this->value_.reset();
    const auto set = [&](auto&& one) { this->value_.emplace(std::forward<decltype(one)>(one)); };
    return src.is_none() || this->template read<T>(src, flags, list, set);
  }
  template <class V>
  static handle from_cpp(V&& of, rv_policy policy, cleanup_list* list) noexcept {
    return optional_caster<std::optional<T>>::from_cpp(std::forward<V>(of), policy, list);
  }
};

}  // namespace nanobind::detail

// Lists and optional values of what throws when it is asked for: nanobind's own are asked where nothing may throw.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "interruption.h"

namespace dymsum::python {

/// Whether the caster of T throws when it is asked for what it has read.
template <class T>
inline constexpr bool kThrowsWhenAsked = false;
template <class T>
inline constexpr bool kThrowsWhenAsked<std::vector<T>> = kThrowsWhenAsked<T>;
template <class T>
inline constexpr bool kThrowsWhenAsked<std::optional<T>> = kThrowsWhenAsked<T>;

/// Whether the object is a sequence, no text, and `read` is true for every item; asks for signals meanwhile. True as
/// well where something has been thrown, of which the rest is not read.
template <class Read>
bool each_item(nb::handle object, Interruption& thrown, Read&& read) noexcept {
  constexpr Py_ssize_t kBetween = 1024;
  if (PyUnicode_Check(object.ptr()) || !PySequence_Check(object.ptr())) return false;
  PyObject* const items = PySequence_Fast(object.ptr(), "");
  if (items == nullptr) {
    try {
      throw nb::python_error();
    } catch (const nb::python_error&) {
      return thrown.keep();
    }
  }
  const nb::object kept = nb::steal(items);
  for (Py_ssize_t k = 0; k < PySequence_Fast_GET_SIZE(items); ++k) {
    if (k % kBetween == kBetween - 1 && thrown.keep_signal()) return true;
    const nb::object item = nb::borrow(PySequence_Fast_ITEMS(items)[k]);
    if (!read(nb::handle(item))) return false;
    if (thrown.kept()) return true;
  }
  return true;
}

}  // namespace dymsum::python

namespace nanobind::detail {

/// What the casters below share.
template <class T>
struct asked_caster {
  using Value = T;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  explicit operator Value() {
    thrown_.raise();
    return std::move(value_);
  }

 protected:
  /// to(what the item is); what it throws is kept.
  template <class Item, class To>
  bool read(handle src, uint32_t flags, cleanup_list* list, To&& to) noexcept {
    make_caster<Item> item;
    if (!item.from_python(src, flags, list)) return false;
    try {
      to(item.operator Item());
    } catch (...) {
      return thrown_.keep();
    }
    return true;
  }
  Value value_;
  dymsum::python::Interruption thrown_;
};

template <class T>
requires dymsum::python::kThrowsWhenAsked<T>
struct type_caster<std::vector<T>> : asked_caster<std::vector<T>> {
  static constexpr auto Name =
      io_name("collections.abc.Sequence", "list") + const_name("[") + make_caster<T>::Name + const_name("]");
  bool from_python(handle src, uint32_t flags, cleanup_list* list) noexcept {
    this->value_.clear();
    return dymsum::python::each_item(src, this->thrown_, [&](handle item) {
      return this->template read<T>(item, flags, list, [&](T&& one) { this->value_.push_back(std::move(one)); });
    });
  }
  template <class V>
  static handle from_cpp(V&& of, rv_policy policy, cleanup_list* list) noexcept {
    return list_caster<std::vector<T>, T>::from_cpp(std::forward<V>(of), policy, list);
  }
};

template <class T>
requires dymsum::python::kThrowsWhenAsked<T>
struct type_caster<std::optional<T>> : asked_caster<std::optional<T>> {
  static constexpr auto Name = optional_caster<std::optional<T>>::Name;
  bool from_python(handle src, uint32_t flags, cleanup_list* list) noexcept {
    this->value_.reset();
    return src.is_none() || this->template read<T>(src, flags, list, [&](T&& one) { this->value_ = std::move(one); });
  }
  template <class V>
  static handle from_cpp(V&& of, rv_policy policy, cleanup_list* list) noexcept {
    return optional_caster<std::optional<T>>::from_cpp(std::forward<V>(of), policy, list);
  }
};

}  // namespace nanobind::detail

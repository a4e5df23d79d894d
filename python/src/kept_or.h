// Arguments that are one class of ours as it is, or else what another one is made of.
#pragma once

#include "arguments.h"
#include "lists.h"

#include <utility>
#include <vector>

namespace dymsum::python {

/// A Kept, or anything that is a Base to Python's other packages; kept alive.
template <class Kept, class Base>
struct KeptOr {
  nb::object object;
  /// Calls f with the one that it is.
  template <class F>
  auto visit(const F& f) const {
    if (nb::isinstance<Kept>(object)) return f(*nb::inst_ptr<Kept>(object));
    return f(*nb::inst_ptr<Base>(object));
  }
};

/// What operations take of a sequence of operands, and the objects that are remembered.
template <class Operand, class Argument>
std::pair<std::vector<Operand>, nb::list> operands_in(const std::vector<Argument>& items) {
  std::pair<std::vector<Operand>, nb::list> all;
  for (const Argument& item : items) {
    all.first.push_back(*item);
    all.second.append(item.object);
  }
  return all;
}

}  // namespace dymsum::python

namespace nanobind::detail {

/// Of a Value with the members of KeptOr<Kept, Base>. A Kept is taken as it is; it would be rounded, or be refused,
/// where it is made a Base.
template <class Value_, class Kept, class Base>
struct kept_or_caster {
  using Value = Value_;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    if (isinstance<Kept>(src)) {
      kept_ = borrow(src);
      return true;
    }
    return base_.from_python(src, flags, list);
  }
  explicit operator Value() {
    Value value;
    value.object = kept_.is_valid() ? kept_ : base_.operator dymsum::python::Argument<Base>().object;
    return value;
  }

 private:
  object kept_;
  argument_caster<Base> base_;
};

/// Of a Value that holds `items` of Item, each read as one.
template <class Value_, class Item>
struct items_caster {
  using Value = Value_;
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    items_.clear();
    return dymsum::python::each_item(src,
                                     [&](handle item) { return items_.emplace_back().from_python(item, flags, list); });
  }
  explicit operator Value() {
    Value all;
    for (std::size_t i = 0; i < items_.size(); ++i)
      all.items.push_back(dymsum::python::of_item(i, [&] { return items_[i].operator Item(); }));
    return all;
  }

 private:
  std::vector<type_caster<Item>> items_;
};

}  // namespace nanobind::detail

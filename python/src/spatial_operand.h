// Operands of operations on solids as Python hands them in.
#pragma once

#include <utility>
#include <vector>

#include "arguments.h"
#include "dymsum/spatial_operand.h"
#include "lists.h"

namespace dymsum::python {

/// A mesh, or anything that is one to Python's other packages, or a SpatialSum; kept alive.
struct SpatialOperandArgument {
  nb::object object;
  SpatialOperand operator*() const {
    if (nb::isinstance<SpatialSum>(object)) return *nb::inst_ptr<SpatialSum>(object);
    return *nb::inst_ptr<Mesh>(object);
  }
};
struct SpatialOperands {
  std::vector<SpatialOperandArgument> items;
};
/// What operations take of them, and the objects that are remembered.
inline std::pair<std::vector<SpatialOperand>, nb::list> operands_of(const SpatialOperands& sets) {
  std::pair<std::vector<SpatialOperand>, nb::list> all;
  for (const SpatialOperandArgument& set : sets.items) {
    all.first.push_back(*set);
    all.second.append(set.object);
  }
  return all;
}

}  // namespace dymsum::python

namespace nanobind::detail {

/// A SpatialSum is taken as it is.
template <>
struct type_caster<dymsum::python::SpatialOperandArgument> {
  using Value = dymsum::python::SpatialOperandArgument;
  static constexpr auto Name = const_name("dymsum.MeshLike | dymsum.SpatialSum");
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    if (isinstance<dymsum::SpatialSum>(src)) {
      sum_ = borrow(src);
      return true;
    }
    return mesh_.from_python(src, flags, list);
  }
  explicit operator Value() {
    if (sum_.is_valid()) return {sum_};
    return {mesh_.operator dymsum::python::MeshArgument().object};
  }

 private:
  object sum_;
  argument_caster<dymsum::Mesh> mesh_;
};

template <>
struct type_caster<dymsum::python::SpatialOperands> {
  using Item = type_caster<dymsum::python::SpatialOperandArgument>;
  using Value = dymsum::python::SpatialOperands;
  static constexpr auto Name = const_name("collections.abc.Sequence[dymsum.MeshLike | dymsum.SpatialSum]");
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
      all.items.push_back(
          dymsum::python::of_item(i, [&] { return items_[i].operator dymsum::python::SpatialOperandArgument(); }));
    return all;
  }

 private:
  std::vector<Item> items_;
};

}  // namespace nanobind::detail

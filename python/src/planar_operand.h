// Operands of planar operations as Python hands them in.
#pragma once

#include "arguments.h"
#include "dymsum/planar_operand.h"
#include "lists.h"

namespace dymsum::python {

/// A region, or anything that is one to Python's other packages, or a PlanarSum; kept alive.
struct PlanarOperandArgument {
  nb::object object;
  PlanarOperand operator*() const {
    if (nb::isinstance<PlanarSum>(object)) return *nb::inst_ptr<PlanarSum>(object);
    return *nb::inst_ptr<Region>(object);
  }
};
struct PlanarOperands {
  std::vector<PlanarOperandArgument> items;
};
/// What operations take of them, and the objects that are remembered.
inline std::pair<std::vector<PlanarOperand>, nb::list> operands_of(const PlanarOperands& sets) {
  std::pair<std::vector<PlanarOperand>, nb::list> all;
  for (const PlanarOperandArgument& set : sets.items) {
    all.first.push_back(*set);
    all.second.append(set.object);
  }
  return all;
}

}  // namespace dymsum::python

namespace nanobind::detail {

/// A PlanarSum is taken as it is; it would be rounded where it is made a region.
template <>
struct type_caster<dymsum::python::PlanarOperandArgument> {
  using Value = dymsum::python::PlanarOperandArgument;
  static constexpr auto Name = const_name("dymsum.RegionLike | dymsum.PlanarSum");
  template <typename U>
  using Cast = Value;
  template <typename U>
  bool can_cast() const {
    return true;
  }
  bool from_python(handle src, uint32_t flags, cleanup_list* list) {
    if (isinstance<dymsum::PlanarSum>(src)) {
      sum_ = borrow(src);
      return true;
    }
    return region_.from_python(src, flags, list);
  }
  explicit operator Value() {
    if (sum_.is_valid()) return {sum_};
    return {region_.operator dymsum::python::RegionArgument().object};
  }

 private:
  object sum_;
  argument_caster<dymsum::Region> region_;
};

template <>
struct type_caster<dymsum::python::PlanarOperands> {
  using Item = type_caster<dymsum::python::PlanarOperandArgument>;
  using Value = dymsum::python::PlanarOperands;
  static constexpr auto Name = const_name("collections.abc.Sequence[dymsum.RegionLike | dymsum.PlanarSum]");
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
          dymsum::python::of_item(i, [&] { return items_[i].operator dymsum::python::PlanarOperandArgument(); }));
    return all;
  }

 private:
  std::vector<Item> items_;
};

}  // namespace nanobind::detail

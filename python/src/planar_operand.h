// Operands of planar operations as Python hands them in.
#pragma once

#include "dymsum/planar_operand.h"
#include "kept_or.h"

#include <utility>
#include <vector>

namespace dymsum::python {

/// A region, or anything that is one to Python's other packages, or a PlanarSum; kept alive.
struct PlanarOperandArgument : KeptOr<PlanarSum, Region> {
  PlanarOperand operator*() const {
    return visit([](const auto& set) { return PlanarOperand(set); });
  }
};
struct PlanarOperands {
  std::vector<PlanarOperandArgument> items;
};
/// What operations take of them, and the objects that are remembered.
inline std::pair<std::vector<PlanarOperand>, nb::list> operands_of(const PlanarOperands& sets) {
  return operands_in<PlanarOperand>(sets.items);
}

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::python::PlanarOperandArgument>
    : kept_or_caster<dymsum::python::PlanarOperandArgument, dymsum::PlanarSum, dymsum::Region> {
  static constexpr auto Name = const_name("dymsum.RegionLike | dymsum.PlanarSum");
};

template <>
struct type_caster<dymsum::python::PlanarOperands>
    : items_caster<dymsum::python::PlanarOperands, dymsum::python::PlanarOperandArgument> {
  static constexpr auto Name = const_name("collections.abc.Sequence[dymsum.RegionLike | dymsum.PlanarSum]");
};

}  // namespace nanobind::detail

// Operands of operations on solids as Python hands them in.
#pragma once

#include "dymsum/spatial_operand.h"
#include "kept_or.h"

#include <utility>
#include <vector>

namespace dymsum::python {

/// A mesh, or anything that is one to Python's other packages, or a SpatialSum; kept alive.
struct SpatialOperandArgument : KeptOr<SpatialSum, Mesh> {
  SpatialOperand operator*() const {
    return visit([](const auto& set) { return SpatialOperand(set); });
  }
};
struct SpatialOperands {
  std::vector<SpatialOperandArgument> items;
};
/// What operations take of them, and the objects that are remembered.
inline std::pair<std::vector<SpatialOperand>, nb::list> operands_of(const SpatialOperands& sets) {
  return operands_in<SpatialOperand>(sets.items);
}

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::python::SpatialOperandArgument>
    : kept_or_caster<dymsum::python::SpatialOperandArgument, dymsum::SpatialSum, dymsum::Mesh> {
  static constexpr auto Name = const_name("dymsum.MeshLike | dymsum.SpatialSum");
};

template <>
struct type_caster<dymsum::python::SpatialOperands>
    : items_caster<dymsum::python::SpatialOperands, dymsum::python::SpatialOperandArgument> {
  static constexpr auto Name = const_name("collections.abc.Sequence[dymsum.MeshLike | dymsum.SpatialSum]");
};

}  // namespace nanobind::detail

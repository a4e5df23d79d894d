// Regions and solids that may not be known exactly, as Python hands them in.
#pragma once

#include "dymsum/uncertain.h"
#include "dymsum/uncertain_solid.h"
#include "kept_or.h"

#include <stdexcept>

namespace dymsum::python {

/// An Uncertain, or a region that is known.
struct UncertainArgument : KeptOr<Uncertain, Region> {
  Uncertain operator*() const {
    if (nb::isinstance<Uncertain>(object)) return *nb::inst_ptr<Uncertain>(object);
    return take(Uncertain::known(*nb::inst_ptr<Region>(object)));
  }
};
/// An UncertainSolid, or a solid that is known.
struct UncertainSolidArgument : KeptOr<UncertainSolid, Mesh> {
  UncertainSolid operator*() const {
    if (nb::isinstance<UncertainSolid>(object)) return *nb::inst_ptr<UncertainSolid>(object);
    return take(UncertainSolid::known(*nb::inst_ptr<Mesh>(object)));
  }
};

/// A position that is finite: exactly.
template <std::size_t K>
const auto& finite(const Position<K>& position) {
  if (!position.exact) throw std::invalid_argument("the position is not finite");
  return *position.exact;
}

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::python::UncertainArgument>
    : kept_or_caster<dymsum::python::UncertainArgument, dymsum::Uncertain, dymsum::Region> {
  static constexpr auto Name = const_name("dymsum.Uncertain | dymsum.RegionLike");
};

template <>
struct type_caster<dymsum::python::UncertainSolidArgument>
    : kept_or_caster<dymsum::python::UncertainSolidArgument, dymsum::UncertainSolid, dymsum::Mesh> {
  static constexpr auto Name = const_name("dymsum.UncertainSolid | dymsum.MeshLike");
};

}  // namespace nanobind::detail

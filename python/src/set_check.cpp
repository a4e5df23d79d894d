// Checks of sets and meshes that anyone made.
#include "dymsum/set_check.h"

#include "bind.h"
#include "calls.h"
#include "dymsum/mesh_check.h"
#include "enumeration.h"
#include "planar_operand.h"
#include "record.h"
#include "spatial_operand.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_set_records(nb::module_& m) {
  enumeration<CheckVerdict>(m, "CheckVerdict", "What a check comes to.",
                            {"", "", "the tolerance lies between the two bounds of a distance"});
  Record<PlanarExcess>(m, "PlanarExcess", "What lies in one set and not in another one, and how far it reaches.")
      .field("set", &PlanarExcess::set, "A PlanarSum, exact; empty where the first set lies in the other one.")
      .field("at", &PlanarExcess::at, "A position that is furthest from the other set.")
      .field("nearest", &PlanarExcess::nearest, "The nearest one of the other set.")
      .field("squared", &PlanarExcess::squared, "The exact square of the distance of these two.")
      .field("distance", &PlanarExcess::distance, "Its nearest double; inf where the other set alone is empty.")
      .field("at_most", &PlanarExcess::at_most, "No position is further away; `distance` where that is `exact`.")
      .field("exact", &PlanarExcess::exact);
  Record<PlanarSetCheck>(m, "PlanarSetCheck", "How a set lies to the right one.")
      .field("missing", &PlanarSetCheck::missing, "What lies in the right set alone.")
      .field("surplus", &PlanarSetCheck::surplus, "What lies in the other one alone.")
      .def("equal", &PlanarSetCheck::equal)
      .def("contains", &PlanarSetCheck::contains, "The right set lies in the other one, which is never too small.")
      .def("contained", &PlanarSetCheck::contained, "The other one lies in the right set: it is never too large.")
      .def("within", &PlanarSetCheck::within, "tolerance"_a,
           "right: no position of either set is further than this from the other one.");
  Record<SolidExcess>(m, "SolidExcess", "The same of solids.")
      .field("set", &SolidExcess::set, "A SpatialSum, exact.")
      .field("at", &SolidExcess::at, "A furthest position of it.")
      .field("nearest", &SolidExcess::nearest, "The nearest position of the other solid.")
      .field("squared", &SolidExcess::squared, "The exact square of the distance of these two.")
      .field("distance", &SolidExcess::distance)
      .field("at_most", &SolidExcess::at_most, "No position is further away.")
      .field("exact", &SolidExcess::exact);
  Record<SolidSetCheck>(m, "SolidSetCheck", "How a solid lies to the right one.")
      .field("missing", &SolidSetCheck::missing, "What lies in the right solid alone.")
      .field("surplus", &SolidSetCheck::surplus, "What lies in the other one alone.")
      .def("equal", &SolidSetCheck::equal)
      .def("contains", &SolidSetCheck::contains)
      .def("contained", &SolidSetCheck::contained)
      .def("within", &SolidSetCheck::within, "tolerance"_a);
  Record<SetCheckOptions> options(m, "SetCheckOptions", "Options of check_set.");
  options.def(
      "__init__",
      [](SetCheckOptions* self, Semantics semantics, Progress progress) {
        new (self) SetCheckOptions{semantics, std::move(progress)};
      },
      "semantics"_a = Semantics::regular, "progress"_a = nb::none());
  options.option("semantics", &SetCheckOptions::semantics, "regular, or closed: segments and points count as well.")
      .option("progress", &SetCheckOptions::progress);
  Record<PlanarOffsetCheck>(m, "PlanarOffsetCheck", "How a set lies to the offsets of A.")
      .field("beyond", &PlanarOffsetCheck::beyond, "What makes it no offset: A beyond it, inside: it beyond A.")
      .field("least_squared", &PlanarOffsetCheck::least_squared, "The exact square of `least`.")
      .field("least", &PlanarOffsetCheck::least, "The least distance of the boundaries.")
      .field("least_at", &PlanarOffsetCheck::least_at, "A position of the set's boundary that is so near,")
      .field("least_from", &PlanarOffsetCheck::least_from, "and that of A's.")
      .field("between", &PlanarOffsetCheck::between, "What lies between both, and what of it is furthest.")
      .def("at_least", &PlanarOffsetCheck::at_least, "r"_a, "Whether it holds the offset by r; inside: lies in it.")
      .def("at_most", &PlanarOffsetCheck::at_most, "r"_a, "Whether it lies in the offset by r; inside: holds it.");
  Record<SolidOffsetCheck>(m, "SolidOffsetCheck", "The same of solids.")
      .field("beyond", &SolidOffsetCheck::beyond)
      .field("least_squared", &SolidOffsetCheck::least_squared)
      .field("least", &SolidOffsetCheck::least)
      .field("least_at", &SolidOffsetCheck::least_at)
      .field("least_from", &SolidOffsetCheck::least_from)
      .field("between", &SolidOffsetCheck::between, "Outside: exact where A is convex.")
      .def("at_least", &SolidOffsetCheck::at_least, "r"_a)
      .def("at_most", &SolidOffsetCheck::at_most, "r"_a);
}

void bind_mesh_check(nb::module_& m) {
  Record<MeshCheck>(m, "MeshCheck", "Everything that is wrong with a mesh.")
      .field("faults", &MeshCheck::faults, "As the errors of Mesh, not raised; the first ones of all.")
      .field("count", &MeshCheck::count, "Of all faults.")
      .field("crossings", &MeshCheck::crossings, "Pairs of faces that cross, touch or lie on each other.")
      .field("open_edges", &MeshCheck::open_edges, "Edges with a face on one side only.")
      .field("shells", &MeshCheck::shells)
      .field("volume", &MeshCheck::volume, "Exact, of closed surfaces; else None.")
      .def("valid", &MeshCheck::valid);
  Record<MeshCheckOptions> options(m, "MeshCheckOptions", "Options of check_mesh.");
  options.def(
      "__init__", [](MeshCheckOptions* self, std::size_t listed) { new (self) MeshCheckOptions{listed}; },
      "listed"_a = 1000);
  options.option("listed", &MeshCheckOptions::listed, "How many faults are kept; all are counted.");
  m.def(
      "check_mesh",
      [](const MeshData& data, const MeshCheckOptions& options) {
        return without_gil([&] { return check_mesh(data, options); });
      },
      "data"_a, "options"_a = MeshCheckOptions(),
      R"doc(Everything that is wrong with a mesh, exactly; nothing is repaired.

>>> from dymsum import MeshData, check_mesh
>>> check = check_mesh(MeshData([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3)]))
>>> check.valid(), check.open_edges, {fault.code.name for fault in check.faults}
(False, 3, {'not_closed'})
)doc");
}

}  // namespace

void bind_set_check(nb::module_& m) {
  bind_set_records(m);
  bind_mesh_check(m);
  m.def(
      "check_set",
      [](const PlanarOperandArgument& right, const PlanarOperandArgument& made, const SetCheckOptions& options) {
        return run_with(options, [&](const SetCheckOptions& own) { return check_set(*right, *made, own); });
      },
      "right"_a, "made"_a, "options"_a = SetCheckOptions(),
      R"doc(Whether a set that anyone made is the right one, exactly. Raises Error: unsupported_operand, cancelled.

>>> from dymsum import check_set, minkowski_sum, shapes
>>> right = minkowski_sum(shapes.rectangle(0, 0, 2, 2), shapes.rectangle(0, 0, 1, 1))
>>> check = check_set(right, [(0, 0), (3, 0), (3, 2), (2, 3), (0, 3)])
>>> check.contains(), check.contained(), check.missing.set.area_exact(), check.missing.squared
(False, True, Fraction(1, 2), Fraction(1, 2))
>>> check.missing.at, check.within(0.75).name
(RationalPoint(x=Fraction(3, 1), y=Fraction(3, 1)), 'right')
)doc");
  m.def(
      "check_set",
      [](const SpatialOperandArgument& right, const SpatialOperandArgument& made, const SpatialOptions& options) {
        return run_with(options, [&](const SpatialOptions& own) { return check_set(*right, *made, own); });
      },
      "right"_a, "made"_a, "options"_a = SpatialOptions(),
      R"doc(The same of solids. Raises Error: unsupported_operand, out_of_range, cancelled, out_of_memory.

>>> from dymsum import check_set, minkowski_sum, solids
>>> cube = solids.box(0, 0, 0, 1, 1, 1)
>>> check = check_set(minkowski_sum(cube, cube), solids.box(0, 0, 0, 2, 2, 1.5))
>>> check.contained(), check.missing.set.volume_exact(), check.missing.squared, check.within(0.5).name
(True, Fraction(2, 1), Fraction(1, 4), 'right')
)doc");
  m.def(
      "check_offset",
      [](const PlanarOperandArgument& a, const PlanarOperandArgument& made, DiscSide side, const Progress& progress) {
        return run(progress, [&](Progress own) { return check_offset(*a, *made, side, own); });
      },
      "a"_a, "made"_a, "side"_a, "progress"_a = nb::none(),
      R"doc(By what distances a set is an offset of A, exactly. Raises Error: unsupported_operand, cancelled.

>>> from dymsum import DiscSide, check_offset, shapes
>>> check = check_offset(shapes.rectangle(0, 0, 4, 4), shapes.rectangle(-1, -1, 5, 5), DiscSide.outside)
>>> check.least, check.between.squared, check.at_least(1).name, check.at_most(1).name
(1.0, Fraction(2, 1), 'right', 'wrong')
)doc");
  m.def(
      "check_offset",
      [](const SpatialOperandArgument& a, const SpatialOperandArgument& made, DiscSide side,
         const SpatialOptions& options) {
        return run_with(options, [&](const SpatialOptions& own) { return check_offset(*a, *made, side, own); });
      },
      "a"_a, "made"_a, "side"_a, "options"_a = SpatialOptions(),
      "The same of solids. Raises Error: unsupported_operand, out_of_range, cancelled, out_of_memory.");
}

}  // namespace dymsum::python

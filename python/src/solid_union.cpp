// Solids by winding number: unions, other Boolean operations, repair of surfaces that cross.
#include "dymsum/solid_union.h"

#include <optional>
#include <vector>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/solid_by_planes.h"
#include "enumeration.h"
#include "record.h"
#include "remember.h"
#include "spatial_operand.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_fill(nb::module_& m) {
  enumeration<Fill>(
      m, "Fill", "Which positions lie inside of closed rings or surfaces, by how often these go around them.",
      {"once or more: the union of sets, their holes taken out",
       "the same, also of sets whose boundaries run the other way", "an odd number: what lies in two sets is outside"});
}

void bind_unions(nb::module_& m) {
  m.def(
      "united",
      [](const MeshDataArgument& surface, Fill fill, const SpatialOptions& options) {
        SpatialSum solid = run_with(options, [&](const SpatialOptions& own) { return united(*surface, fill, own); });
        return remembered(std::move(solid), "united", *surface, fill, options);
      },
      "surface"_a, "fill"_a = Fill::positive, "options"_a = SpatialOptions(),
      R"(The solid that closed surfaces bound, whatever they cross, touch or lie on: exactly. Faces that are not plane
count as their triangles. Raises Error: not_finite; bad_index; not_closed with a position; cancelled; out_of_memory.)");
  m.def(
      "united",
      [](const SpatialOperands& solids, const SpatialOptions& options) {
        const auto [all, kept] = operands_of(solids);
        SpatialSum solid = run_with(options, [&, &all = all](const SpatialOptions& own) {
          return united(std::span<const SpatialOperand>(all), own);
        });
        return remembered(std::move(solid), "united", kept, options);
      },
      "solids"_a, "options"_a = SpatialOptions(), R"(The union of any number of solids, exactly.

>>> from dymsum import solids, united
>>> united([solids.box(0, 0, 0, 2, 2, 2), solids.box(1, 1, 1, 3, 3, 3)]).volume_exact()
Fraction(15, 1)
)");
}

using OfTwo = Result<SpatialSum> (*)(const SpatialOperand&, const SpatialOperand&, const SpatialOptions&);

template <OfTwo operation>
void bind_of_two(nb::module_& m, const char* name, const char* text) {
  m.def(
      name,
      [name](const SpatialOperandArgument& a, const SpatialOperandArgument& b, const SpatialOptions& options) {
        SpatialSum solid = run_with(options, [&](const SpatialOptions& own) { return operation(*a, *b, own); });
        return remembered(std::move(solid), name, a.object, b.object, options);
      },
      "a"_a, "b"_a, "options"_a = SpatialOptions(), text);
}

void bind_by_planes(nb::module_& m) {
  Record<SolidByPlanes>(m, "SolidByPlanes", "A solid whose faces are plane as they were meant, and how far that is.")
      .field("solid", &SolidByPlanes::solid, "exact, an operand like every result")
      .field("axes", &SolidByPlanes::axes, "of its parts, other than those of the coordinates")
      .field("tolerance", &SolidByPlanes::tolerance)
      .field("largest_move", &SolidByPlanes::largest_move, "no vertex is further from where it was; proved")
      .field("merged", &SolidByPlanes::merged, "coordinates along an axis that became one with another one")
      .field("bent_faces", &SolidByPlanes::bent_faces, "polygons in no plane, which became triangles")
      .field("faces", &SolidByPlanes::faces, "of the data")
      .def("to_string", &SolidByPlanes::to_string);
  Record<PlanesOptions> options(m, "PlanesOptions", "Options of by_planes.");
  options.def(
      "__init__",
      [](PlanesOptions* self, std::optional<double> tolerance, const SpatialOptions& sums) {
        new (self) PlanesOptions{tolerance, sums};
      },
      "tolerance"_a = nb::none(), "sums"_a = SpatialOptions());
  options.option("tolerance", &PlanesOptions::tolerance, "the most that a vertex may move; None: by the coordinates")
      .option("sums", &PlanesOptions::sums, "of the union that makes the solid");
  m.def(
      "by_planes",
      [](const std::vector<MeshData>& solids, const PlanesOptions& options) {
        return run_with(options.sums, [&](const SpatialOptions& own) {
          return by_planes(solids, {options.tolerance, own});
        });
      },
      "solids"_a, "options"_a = PlanesOptions(),
      "The same of several, with axes in common where none has more directions of planes for that.");
  m.def(
      "by_planes",
      [](const MeshDataArgument& data, const PlanesOptions& options) {
        return run_with(options.sums, [&](const SpatialOptions& own) {
          return by_planes(*data, {options.tolerance, own});
        });
      },
      "data"_a, "options"_a = PlanesOptions(),
      R"(The solid whose faces are plane and parallel where those of the data are but for rounding, exactly: turned boxes,
prisms and what is made of them. Raises Error: out_of_range for a tolerance that is too small; no_area where nothing
is left; not_finite; bad_index; too_few_vertices; not_closed; cancelled; out_of_memory.

>>> from math import cos, sin
>>> from dymsum import MeshData, by_planes, solids
>>> box = solids.box(0, 0, 0, 1, 2, 3)
>>> turned = [(cos(1) * x - sin(1) * y, sin(1) * x + cos(1) * y, z) for x, y, z in box.vertices]
>>> part = by_planes(MeshData(turned, box.faces))
>>> len(part.solid.faces), part.largest_move < 1e-11
(6, True)
)");
}

}  // namespace

void bind_solid_union(nb::module_& m) {
  bind_fill(m);
  bind_unions(m);
  bind_by_planes(m);
  bind_of_two<intersection>(
      m, "intersection",
      "What lies in both solids, exactly; with closed or open semantics what only touches is listed as tight.");
  m.def(
      "intersection",
      [](const SpatialOperands& solids, const SpatialOptions& options) {
        const auto [all, kept] = operands_of(solids);
        SpatialSum solid = run_with(options, [&, &all = all](const SpatialOptions& own) {
          return intersection(std::span<const SpatialOperand>(all), own);
        });
        return remembered(std::move(solid), "intersection", kept, options);
      },
      "solids"_a, "options"_a = SpatialOptions(), "What lies in all of some solids, exactly.");
  bind_of_two<difference>(m, "difference", "What lies in the first solid and not in the second, exactly.");
  bind_of_two<symmetric_difference>(m, "symmetric_difference", "What lies in one of two solids, exactly.");
  m.def(
      "repair_with_union",
      [](const MeshDataArgument& data, Fill fill, const SpatialOptions& options) {
        return run_with(options, [&](const SpatialOptions& own) { return repair_with_union(*data, fill, own); });
      },
      "data"_a, "fill"_a = Fill::nonzero, "options"_a = SpatialOptions(),
      "repair, and where faces cross, touch or lie on each other, the solid that they bound, rounded. Raises Error: "
      "those of repair; cancelled; out_of_memory.");
  m.def(
      "repair_with_union",
      [](const MeshDataArgument& data, Fill fill, const MeshRepairOptions& repairs, const SpatialOptions& options) {
        return run_with(options,
                        [&](const SpatialOptions& own) { return repair_with_union(*data, fill, repairs, own); });
      },
      "data"_a, "fill"_a, "repairs"_a, "options"_a = SpatialOptions(),
      "The same with the repairs that are named alone, with positions, and with loose walls dropped.");
}

}  // namespace dymsum::python

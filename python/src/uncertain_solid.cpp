// Solids that are not known exactly, and questions about them.
#include "dymsum/uncertain_solid.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "record.h"
#include "spatial_operand.h"
#include "uncertain_argument.h"

#include <array>
#include <string>
#include <vector>

namespace dymsum::python {
namespace {

using namespace nb::literals;

template <class Make>
UncertainSolid made_solid(const Make& make) {
  return take(without_gil(make));
}

void bind_making_solids(nb::class_<UncertainSolid>& type) {
  type.def_static(
          "known", [](const MeshArgument& solid) { return made_solid([&] { return UncertainSolid::known(*solid); }); },
          "solid"_a, "A solid that is known: it is the only variant. Raises Error: unsupported_operand for thin parts.")
      .def_static(
          "between",
          [](const SpatialOperandArgument& inner, const SpatialOperandArgument& outer) {
            return made_solid([&] { return UncertainSolid::between(*inner, *outer); });
          },
          "inner"_a, "outer"_a, "Any two sets, one in the other. Raises Error: out_of_range.")
      .def_static(
          "of_variants",
          [](const Many<Mesh>& variants, const Progress& progress) {
            std::vector<Mesh> all;
            for (const MeshArgument& variant : variants.items) all.push_back(*variant);
            return run(progress, [&](Progress own) { return UncertainSolid::of_variants(std::move(all), own); });
          },
          "variants"_a, "progress"_a = nb::none(),
          "One of these solids: their intersection and union. Raises Error: out_of_range for none, cancelled.")
      .def_static(
          "of_band",
          [](const MeshArgument& nominal, const Tolerance& tolerance, double within) {
            return made_solid([&] { return UncertainSolid::of_band(*nominal, tolerance, within); });
          },
          "nominal"_a, "tolerance"_a, "within"_a = 0.0,
          "All between the offsets by tolerance.lower and by tolerance.upper; balls of facets reach at most `within` "
          "further, 0: a sixteenth of the larger deviation. Raises Error: out_of_range.")
      .def_static(
          "of_boxes",
          [](const MeshArgument& nominal, const std::vector<std::array<double, 6>>& boxes, const Progress& progress) {
            return run(progress, [&](Progress own) { return UncertainSolid::of_boxes(*nominal, boxes, own); });
          },
          "nominal"_a, "boxes"_a, "progress"_a = nb::none(),
          "Solids whose vertices are in their boxes (min x, min y, min z, max x, max y, max z). Raises Error: "
          "out_of_range.")
      .def_static(
          "of_rounding",
          [](const MeshArgument& nominal, std::int64_t ulps) {
            return made_solid([&] { return UncertainSolid::of_rounding(*nominal, ulps); });
          },
          "nominal"_a, "ulps"_a = 1, "Solids whose coordinates are each at most so many doubles away.");
}

void bind_uncertain_solid_class(nb::module_& m) {
  nb::class_<UncertainSolid> type(
      m, "UncertainSolid",
      R"doc(A solid of which variants are possible: each contains `inner` and lies in `outer`.

>>> from dymsum import UncertainSolid, solids
>>> part = UncertainSolid.of_variants([solids.box(0, 0, 0, 2, 1, 1), solids.box(0, 0, 0, 1, 1, 2)])
>>> part.inner.volume_exact(), part.outer.volume_exact(), part.exact()
(Fraction(1, 1), Fraction(3, 1), False)
)doc");
  bind_making_solids(type);
  type.def_prop_ro("inner", &UncertainSolid::inner, nb::rv_policy::reference_internal,
                   "In every variant: a SpatialSum.")
      .def_prop_ro("outer", &UncertainSolid::outer, nb::rv_policy::reference_internal,
                   "Around every variant: a SpatialSum.")
      .def_prop_ro(
          "variants", [](const UncertainSolid& self) { return self.variants(); },
          "All variants, where there are finitely many; else none.")
      .def("exact", &UncertainSolid::exact, "Both sets are equal.")
      .def_prop_ro("error", &UncertainSolid::error, "By how much facets make tolerances of balls wider.")
      .def(
          "doubtful", [](const UncertainSolid& self) { return take(without_gil([&] { return self.doubtful(); })); },
          "What lies in the outer set alone: a SpatialSum.")
      .def("__repr__", [](const UncertainSolid& self) {
        const std::string count = std::to_string(self.variants().size());
        if (self.exact()) return std::string("UncertainSolid(exact)");
        return "UncertainSolid(" + (self.variants().empty() ? std::string("between two sets)") : count + " variants)");
      });
}

/// An operation of two, as an overload of that of solids.
template <Result<UncertainSolid> (*operation)(const UncertainSolid&, const UncertainSolid&, const SpatialOptions&)>
void bind_solid_operation(nb::module_& m, const char* name, const char* a, const char* b, const char* doc) {
  m.def(
      name,
      [](const UncertainSolidArgument& p, const UncertainSolidArgument& q, const SpatialOptions& options) {
        const UncertainSolid first = *p, second = *q;
        return run_with(options, [&](const SpatialOptions& own) { return operation(first, second, own); });
      },
      nb::arg(a), nb::arg(b), "options"_a = SpatialOptions(), doc);
}

void bind_solid_operations(nb::module_& m) {
  bind_solid_operation<minkowski_sum>(m, "minkowski_sum", "p", "q", "Of solids, likewise: an UncertainSolid.");
  bind_solid_operation<erode>(m, "erode", "p", "q", "Of solids, likewise: an UncertainSolid.");
  bind_solid_operation<united>(m, "united", "a", "b", "Of solids, likewise: an UncertainSolid.");
  bind_solid_operation<intersection>(m, "intersection", "a", "b", "Of solids, likewise: an UncertainSolid.");
  bind_solid_operation<difference>(m, "difference", "a", "b", "Of solids, likewise: an UncertainSolid.");
}

void bind_solid_answer_records(nb::module_& m) {
  nb::class_<UncertainSolidFit>(m, "UncertainSolidFit", "Whether a solid fits somewhere.")
      .def_ro("answer", &UncertainSolidFit::answer)
      .def_ro("positions", &UncertainSolidFit::positions,
              "Where every variant fits, and where some may: an UncertainSolid.")
      .def_ro("common", &UncertainSolidFit::common, "A position at which every variant fits into every one, or None.");
  Record<SolidClearanceBound>(m, "SolidClearanceBound", "An end of an interval of distances.")
      .field("distance", &SolidClearanceBound::distance, "A SolidDistance; contacts only where both are variants.")
      .field("of", &SolidClearanceBound::of, "Which pair has it.");
  Record<UncertainSolidClearance>(m, "UncertainSolidClearance", "How far apart, or how deep in each other.")
      .field("least", &UncertainSolidClearance::least)
      .field("most", &UncertainSolidClearance::most)
      .def("least_signed", &UncertainSolidClearance::least_signed, "Gaps are positive, depths negative.")
      .def("most_signed", &UncertainSolidClearance::most_signed);
}

/// A question about two solids and a position, as an overload of that of regions.
template <auto question>
void bind_solid_question(nb::module_& m, const char* name, const char* doc) {
  m.def(
      name,
      [](const UncertainSolidArgument& p, const UncertainSolidArgument& q, const Position<3>& at) {
        const UncertainSolid first = *p, second = *q;
        const RationalPoint3& there = finite(at);
        return take(without_gil([&] { return question(first, second, there); }));
      },
      "p"_a, "q"_a, "at"_a = nb::make_tuple(0.0, 0.0, 0.0), doc);
}

using SolidQuestion = Result<UncertainAnswer> (*)(const UncertainSolid&, const UncertainSolid&, const RationalPoint3&);
using SolidClearanceQuestion = Result<UncertainSolidClearance> (*)(const UncertainSolid&, const UncertainSolid&,
                                                                   const RationalPoint3&);

void bind_solid_answers(nb::module_& m) {
  m.def(
      "contains",
      [](const UncertainSolidArgument& p, const UncertainSolidArgument& q, const Position<3>& z, Semantics semantics) {
        const UncertainSolid first = *p, second = *q;
        const RationalPoint3& at = finite(z);
        return take(without_gil([&] { return contains(first, second, at, semantics); }));
      },
      "p"_a, "q"_a, "z"_a, "semantics"_a = Semantics::closed, "Of solids, likewise: an UncertainAnswer.");
  bind_solid_question<static_cast<SolidQuestion>(collides)>(m, "collides", "Of solids, likewise.");
  bind_solid_question<static_cast<SolidQuestion>(fits_at)>(m, "fits_at", "Of solids, likewise.");
  bind_solid_question<static_cast<SolidClearanceQuestion>(clearance)>(m, "clearance", "Of solids, likewise.");
  m.def(
      "fits_anywhere",
      [](const UncertainSolidArgument& container, const UncertainSolidArgument& part, const SpatialOptions& options) {
        const UncertainSolid first = *container, second = *part;
        return run_with(options, [&](const SpatialOptions& own) { return fits_anywhere(first, second, own); });
      },
      "container"_a, "part"_a, "options"_a = SpatialOptions(), "Of solids, likewise: an UncertainSolidFit.");
}

}  // namespace

void bind_uncertain_solid(nb::module_& m) {
  bind_uncertain_solid_class(m);
  bind_solid_operations(m);
  bind_solid_answer_records(m);
  bind_solid_answers(m);
}

}  // namespace dymsum::python

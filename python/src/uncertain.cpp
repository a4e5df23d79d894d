// Regions that are not known exactly, questions about them, robustness of answers.
#include "dymsum/uncertain.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/robustness.h"
#include "dymsum/uncertain_answers.h"
#include "enumeration.h"
#include "planar_operand.h"
#include "record.h"
#include "uncertain_argument.h"

#include <array>
#include <span>

namespace dymsum::python {
namespace {

using namespace nb::literals;

template <class Make>
Uncertain made(const Make& make) {
  return take(without_gil(make));
}

void bind_tolerance(nb::module_& m) {
  Record<Tolerance> tolerance(m, "Tolerance",
                              "How far a boundary may lie outside (positive) or inside (negative) of the nominal one.");
  tolerance.def(
      "__init__",
      [](Tolerance* self, double upper, double lower, int sides) {
        new (self) Tolerance{upper, lower, sides};
      },
      "upper"_a = 0.0, "lower"_a = 0.0, "sides"_a = 32);
  tolerance.option("upper", &Tolerance::upper, "At most so far outside.")
      .option("lower", &Tolerance::lower, "At least so far outside; negative: inside.")
      .option("sides", &Tolerance::sides, "Of the polygons that stand for discs; a multiple of 4.");
}

void bind_making(nb::class_<Uncertain>& type) {
  type.def_static(
          "known", [](const RegionArgument& region) { return made([&] { return Uncertain::known(*region); }); },
          "region"_a, "A region that is known: it is the only variant.")
      .def_static(
          "between",
          [](const PlanarOperandArgument& inner, const PlanarOperandArgument& outer) {
            return made([&] { return Uncertain::between(*inner, *outer); });
          },
          "inner"_a, "outer"_a, "Any two sets, one in the other. Raises Error: out_of_range.")
      .def_static(
          "of_variants",
          [](const Many<Region>& variants, const Progress& progress) {
            std::vector<Region> all;
            for (const RegionArgument& variant : variants.items) all.push_back(*variant);
            return run(progress, [&](Progress own) { return Uncertain::of_variants(std::move(all), own); });
          },
          "variants"_a, "progress"_a = nb::none(),
          "One of these regions: their intersection and union. Raises Error: out_of_range for none, cancelled.")
      .def_static(
          "of_band",
          [](const RegionArgument& nominal, const Tolerance& tolerance) {
            return made([&] { return Uncertain::of_band(*nominal, tolerance); });
          },
          "nominal"_a, "tolerance"_a,
          "All between the offsets of a region by tolerance.lower and by tolerance.upper. Raises Error: out_of_range.")
      .def_static(
          "of_boxes",
          [](const RegionArgument& nominal, const std::vector<std::array<double, 4>>& boxes) {
            return made([&] { return Uncertain::of_boxes(*nominal, boxes); });
          },
          "nominal"_a, "boxes"_a,
          "Regions whose vertices are in their boxes (min x, min y, max x, max y). Raises Error: out_of_range.")
      .def_static(
          "of_discs",
          [](const RegionArgument& nominal, const std::vector<double>& radii, int sides) {
            return made([&] { return Uncertain::of_discs(*nominal, radii, sides); });
          },
          "nominal"_a, "radii"_a, "sides"_a = 32,
          "Regions whose vertices are each at most so far away. Raises Error: out_of_range.")
      .def_static(
          "of_rounding",
          [](const RegionArgument& nominal, std::int64_t ulps) {
            return made([&] { return Uncertain::of_rounding(*nominal, ulps); });
          },
          "nominal"_a, "ulps"_a = 1, "Regions whose coordinates are each at most so many doubles away.")
      .def_static(
          "of_scales",
          [](const RegionArgument& nominal, const ScaleArgument& low, const ScaleArgument& high) {
            const Scale from = low.value(), to = high.value();
            return made([&] { return Uncertain::of_scales(*nominal, from, to); });
          },
          "nominal"_a, "low"_a, "high"_a, "s times the region for s from low to high. Raises Error: bad_scale.")
      .def_static(
          "of_angles",
          [](const RegionArgument& nominal, const Orientation& a, const Orientation& b, double distance) {
            return made([&] { return Uncertain::of_angles(*nominal, a, b, distance); });
          },
          "nominal"_a, "a"_a, "b"_a, "distance"_a,
          "The region turned by an angle from a counter-clockwise to b, within `distance` of the exact sets.");
}

void bind_uncertain_class(nb::module_& m) {
  nb::class_<Uncertain> type(m, "Uncertain",
                             R"doc(A region of which variants are possible: each contains `inner` and lies in `outer`.

>>> from dymsum import Tolerance, Uncertain, shapes
>>> part = Uncertain.of_band(shapes.rectangle(0, 0, 4, 2), Tolerance(0.5, -0.25, sides=4))
>>> part.inner.area_exact(), part.outer.area_exact(), part.exact()
(Fraction(21, 4), Fraction(15, 1), False)
)doc");
  bind_making(type);
  type.def_prop_ro("inner", &Uncertain::inner, nb::rv_policy::reference_internal, "In every variant: a PlanarSum.")
      .def_prop_ro("outer", &Uncertain::outer, nb::rv_policy::reference_internal, "Around every variant: a PlanarSum.")
      .def_prop_ro(
          "variants", [](const Uncertain& self) { return self.variants(); },
          "All variants, where there are finitely many; else none.")
      .def("exact", &Uncertain::exact, "Both sets are equal.")
      .def_prop_ro("error", &Uncertain::error, "By how much polygons make tolerances of discs wider.")
      .def(
          "doubtful", [](const Uncertain& self) { return take(without_gil([&] { return self.doubtful(); })); },
          "What lies in the outer set alone: a PlanarSum.")
      .def("__repr__", [](const Uncertain& self) {
        const std::string count = std::to_string(self.variants().size());
        return self.exact()
                   ? std::string("Uncertain(exact)")
                   : "Uncertain(" + (self.variants().empty() ? std::string("between two sets)") : count + " variants)");
      });
}

/// An operation of two, as an overload of that of regions.
template <Result<Uncertain> (*operation)(const Uncertain&, const Uncertain&, const SumOptions&)>
void bind_operation(nb::module_& m, const char* name, const char* a, const char* b, const char* doc) {
  m.def(
      name,
      [](const UncertainArgument& p, const UncertainArgument& q, const SumOptions& options) {
        const Uncertain first = *p, second = *q;
        return run_with(options, [&](const SumOptions& own) { return operation(first, second, own); });
      },
      nb::arg(a), nb::arg(b), "options"_a = SumOptions(), doc);
}

void bind_operations(nb::module_& m) {
  bind_operation<minkowski_sum>(m, "minkowski_sum", "p", "q",
                                "Of every variant of one with every one of the other: an Uncertain.");
  bind_operation<nfp>(m, "nfp", "a", "b", "Of every variant of one with every one of the other: an Uncertain.");
  bind_operation<erode>(m, "erode", "p", "q",
                        R"doc(The positions at which every variant fits (inner), and those at which some may (outer).

>>> from dymsum import Tolerance, Uncertain, erode, shapes
>>> slot = Uncertain.of_band(shapes.rectangle(0, 0, 20, 40), Tolerance(0.25, 0, sides=4))
>>> fit = erode(slot, shapes.rectangle(0, 0, 20, 10))
>>> fit.inner.parts, len(fit.inner.segments), fit.outer.area()
([], 1, 15.25)
)doc");
  bind_operation<united>(m, "united", "a", "b", "Of every variant with every one: an Uncertain.");
  bind_operation<intersection>(m, "intersection", "a", "b", "Of every variant with every one: an Uncertain.");
  bind_operation<difference>(m, "difference", "a", "b", "Of every variant without every one: an Uncertain.");
}

void bind_answer_records(nb::module_& m) {
  enumeration<Holds>(m, "Holds", "For which variants something holds.");
  Record<VariantPair> pair(m, "VariantPair", "A variant of each operand, by index; or kInner, kOuter for a set.");
  pair.field("p", &VariantPair::p).field("q", &VariantPair::q);
  pair.attr("kInner") = VariantPair::kInner;
  pair.attr("kOuter") = VariantPair::kOuter;
  Record<UncertainAnswer>(m, "UncertainAnswer", "An answer for all, for some, or for no variants.")
      .field("holds", &UncertainAnswer::holds)
      .field("yes", &UncertainAnswer::yes, "A pair for which it holds; None where it holds for none.")
      .field("no", &UncertainAnswer::no, "A pair for which it does not; None where it holds for all.");
  nb::class_<UncertainFit>(m, "UncertainFit", "Whether a part fits somewhere.")
      .def_ro("answer", &UncertainFit::answer)
      .def_ro("positions", &UncertainFit::positions, "Where every variant fits, and where some may: an Uncertain.")
      .def_ro("common", &UncertainFit::common, "A position at which every variant fits into every one, or None.");
  Record<ClearanceBound>(m, "ClearanceBound", "An end of an interval of distances.")
      .field("distance", &ClearanceBound::distance, "A PlanarDistance; contacts only where both are variants.")
      .field("of", &ClearanceBound::of, "Which pair has it.");
  Record<UncertainClearance>(m, "UncertainClearance", "How far apart, or how deep in each other.")
      .field("least", &UncertainClearance::least)
      .field("most", &UncertainClearance::most)
      .def("least_signed", &UncertainClearance::least_signed, "Gaps are positive, depths negative.")
      .def("most_signed", &UncertainClearance::most_signed);
}

void bind_answers(nb::module_& m) {
  m.def(
      "contains",
      [](const UncertainArgument& p, const UncertainArgument& q, const Position<2>& z, Semantics semantics) {
        const Uncertain first = *p, second = *q;
        const RationalPoint& at = finite(z);
        return take(without_gil([&] { return contains(first, second, at, semantics); }));
      },
      "p"_a, "q"_a, "z"_a, "semantics"_a = Semantics::closed,
      "Whether z lies in P (+) Q for all variants, for some or for none: an UncertainAnswer.");
  m.def(
      "collides",
      [](const UncertainArgument& p, const UncertainArgument& q, const Position<2>& at) {
        const Uncertain first = *p, second = *q;
        const RationalPoint& there = finite(at);
        return take(without_gil([&] { return collides(first, second, there); }));
      },
      "p"_a, "q"_a, "at"_a = nb::make_tuple(0.0, 0.0), "Whether the interiors of P and of Q, moved, meet.");
  m.def(
      "fits_at",
      [](const UncertainArgument& p, const UncertainArgument& q, const Position<2>& at) {
        const Uncertain first = *p, second = *q;
        const RationalPoint& there = finite(at);
        return take(without_gil([&] { return fits_at(first, second, there); }));
      },
      "p"_a, "q"_a, "at"_a, "Whether Q, moved, lies in P.");
  m.def(
      "fits_anywhere",
      [](const UncertainArgument& container, const UncertainArgument& part, const SumOptions& options) {
        const Uncertain first = *container, second = *part;
        return run_with(options, [&](const SumOptions& own) { return fits_anywhere(first, second, own); });
      },
      "container"_a, "part"_a, "options"_a = SumOptions(),
      R"doc(Whether a part fits somewhere: for all variants, for some or for none.

>>> from dymsum import Uncertain, fits_anywhere, shapes
>>> slot, part = shapes.rectangle(0, 0, 0.3, 1), shapes.rectangle(0, 0, 0.1 + 0.2, 0.5)
>>> fits_anywhere(slot, part).answer.holds.name
'for_none'
>>> fits_anywhere(Uncertain.of_rounding(slot), Uncertain.of_rounding(part)).answer.holds.name
'for_some'
)doc");
  m.def(
      "clearance",
      [](const UncertainArgument& p, const UncertainArgument& q, const Position<2>& at) {
        const Uncertain first = *p, second = *q;
        const RationalPoint& there = finite(at);
        return take(without_gil([&] { return clearance(first, second, there); }));
      },
      "p"_a, "q"_a, "at"_a = nb::make_tuple(0.0, 0.0), "How far P and Q, moved, are apart or overlap: both bounds.");
}

void bind_robustness_records(nb::module_& m) {
  Record<Robustness>(m, "Robustness", "The largest r so that an answer holds when all points move by up to r.")
      .field("holds", &Robustness::holds, "The answer for the regions as they are.")
      .field("squared", &Robustness::squared, "r ** 2, exact.")
      .field("radius", &Robustness::radius)
      .field("ways", &Robustness::ways, "The moves of Q, 2 r long, after which it touches, with contacts.");
  Record<RobustFit>(m, "RobustFit", "The position at which a part fits with the most clearance.")
      .field("fits", &RobustFit::fits)
      .field("at", &RobustFit::at)
      .field("squared", &RobustFit::squared)
      .field("radius", &RobustFit::radius)
      .field("at_most", &RobustFit::at_most, "No position has more.")
      .field("exact", &RobustFit::exact);
  Record<FitStackRow>(m, "FitStackRow", "How far an edge of a container is from the part, with tolerances.")
      .field("container", &FitStackRow::container)
      .field("part", &FitStackRow::part)
      .field("squared", &FitStackRow::squared)
      .field("nominal", &FitStackRow::nominal)
      .field("least", &FitStackRow::least)
      .field("most", &FitStackRow::most)
      .field("of_container", &FitStackRow::of_container)
      .field("of_part", &FitStackRow::of_part);
  Record<FitStack>(m, "FitStack", "The clearances of a fit, by the least.")
      .field("fits", &FitStack::fits)
      .field("rows", &FitStack::rows);
}

void bind_robustness(nb::module_& m) {
  bind_robustness_records(m);
  m.def(
      "robustness_of_free",
      [](const RegionArgument& p, const RegionArgument& q, const Position<2>& at) {
        const RationalPoint& there = finite(at);
        return take(without_gil([&] { return robustness_of_free(*p, *q, there); }));
      },
      "p"_a, "q"_a, "at"_a = nb::make_tuple(0.0, 0.0),
      R"doc(By how much both regions may change so that Q, moved, still does not overlap P.

>>> from dymsum import robustness_of_free, shapes
>>> unit = shapes.rectangle(0, 0, 1, 1)
>>> robustness_of_free(unit, unit, (4, 5)).radius
2.5
)doc");
  m.def(
      "robustness_of_fit",
      [](const RegionArgument& container, const RegionArgument& part, const Position<2>& at) {
        const RationalPoint& there = finite(at);
        return take(without_gil([&] { return robustness_of_fit(*container, *part, there); }));
      },
      "container"_a, "part"_a, "at"_a, "By how much both may change so that the part, moved, still lies in it.");
  m.def(
      "most_robust_fit",
      [](const RegionArgument& container, const RegionArgument& part) {
        return take(without_gil([&] { return most_robust_fit(*container, *part); }));
      },
      "container"_a, "part"_a,
      R"doc(The position at which a part fits with the most clearance.

>>> from dymsum import most_robust_fit, shapes
>>> most_robust_fit(shapes.rectangle(0, 0, 10, 6), shapes.rectangle(0, 0, 4, 2)).radius
1.0
)doc");
  m.def(
      "fit_stack",
      [](const RegionArgument& container, const std::vector<Tolerance>& of_container, const RegionArgument& part,
         const std::vector<Tolerance>& of_part, const Position<2>& at) {
        const RationalPoint& there = finite(at);
        return take(without_gil([&] { return fit_stack(*container, of_container, *part, of_part, there); }));
      },
      "container"_a, "container_tolerances"_a, "part"_a, "part_tolerances"_a, "at"_a,
      R"doc(The clearances of a part in a container, edge by edge; a tolerance for all vertices or one for each.

>>> from dymsum import Tolerance, fit_stack, shapes
>>> slot, peg = shapes.rectangle(0, 0, 20, 40), shapes.rectangle(-9.875, 0, 9.875, 10)
>>> row = fit_stack(slot, [Tolerance(0.0625, 0)], peg, [Tolerance(0, -0.03125)], (10, 5)).rows[0]
>>> row.container.index, row.nominal, row.least, row.most
(1, 0.125, 0.125, 0.21875)
)doc");
}

}  // namespace

void bind_uncertain(nb::module_& m) {
  bind_tolerance(m);
  bind_uncertain_class(m);
  bind_operations(m);
  bind_answer_records(m);
  bind_answers(m);
  bind_robustness(m);
}

}  // namespace dymsum::python

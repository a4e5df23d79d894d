// Boolean operations of regions and results.
#include "dymsum/planar_boolean.h"

#include "dymsum/region_by_lines.h"

#include "bind.h"
#include "calls.h"
#include "planar_operand.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

using PlanarOperations = Result<PlanarSum> (*)(std::span<const PlanarOperand>, const SumOptions&);
using PlanarOperation = Result<PlanarSum> (*)(const PlanarOperand&, const PlanarOperand&, const SumOptions&);

template <PlanarOperations operation>
void bind_boolean_of_many(nb::module_& m, const char* name, const char* text) {
  m.def(
      name,
      [name](const PlanarOperands& sets, const SumOptions& options) {
        const auto [all, given] = operands_of(sets);
        PlanarSum sum = run_with(options, [&](const SumOptions& own) { return operation(all, own); });
        return remembered(std::move(sum), name, given, options);
      },
      "sets"_a, "options"_a = SumOptions(), text);
}

template <PlanarOperation operation>
auto boolean_of_two(const char* name) {
  return [name](const PlanarOperandArgument& a, const PlanarOperandArgument& b, const SumOptions& options) {
    PlanarSum sum = run_with(options, [&](const SumOptions& own) { return operation(*a, *b, own); });
    return remembered(std::move(sum), name, a.object, b.object, options);
  };
}

template <PlanarOperation operation>
void bind_boolean_of_two(nb::module_& m, const char* name, const char* sign, const char* text) {
  m.def(name, boolean_of_two<operation>(name), "a"_a, "b"_a, "options"_a = SumOptions(), text);
  const auto define = [&](auto type) {
    type.def(
        sign,
        [name](const PlanarOperandArgument& a, const PlanarOperandArgument& b) {
          SumOptions options;
          options.semantics = Semantics::regular;
          return boolean_of_two<operation>(name)(a, b, options);
        },
        nb::is_operator(), text);
  };
  define(nb::borrow<nb::class_<Region>>(nb::type<Region>()));
  define(nb::borrow<nb::class_<PlanarSum>>(nb::type<PlanarSum>()));
}

void bind_fill_report(nb::module_& m) {
  Record<FillReport>(m, "FillReport", "What repair_with_fill changed.")
      .field("rings", &FillReport::rings)
      .field("rings_now", &FillReport::rings_now)
      .field("crossings", &FillReport::crossings, "at which rings crossed or touched")
      .field("rounding", &FillReport::rounding)
      .field("filled", &FillReport::filled, "the rings were no valid region")
      .def("changed", &FillReport::changed)
      .def("to_string", &FillReport::to_string);
  Record<FilledRegion>(m, "FilledRegion", "A region that rings bound, and what was changed.")
      .field("region", &FilledRegion::region)
      .field("report", &FilledRegion::report);
  m.def(
      "repair_with_fill",
      [](const RegionDataArgument& rings, Fill fill) { return take(repair_with_fill(*rings, fill)); }, "rings"_a,
      "fill"_a = Fill::nonzero,
      "What rings bound that cross themselves or each other, with its vertices rounded. Raises Error: not_finite; "
      "unsupported_operand.");
}

void bind_by_lines(nb::module_& m) {
  Record<RegionByLines>(m, "RegionByLines",
                        "A region whose edges lie on the lines they were meant for, and how far that is.")
      .field("region", &RegionByLines::region, "exact, an operand like every result")
      .field("axes", &RegionByLines::axes, "of its rings, other than those of the coordinates")
      .field("tolerance", &RegionByLines::tolerance)
      .field("largest_move", &RegionByLines::largest_move, "no vertex is further from where it was; proved")
      .field("merged", &RegionByLines::merged, "coordinates along an axis, and lines, that became one with another one")
      .field("loose_edges", &RegionByLines::loose_edges, "parallel to others but for rounding, and left so")
      .field("edges", &RegionByLines::edges, "of the data")
      .def("to_string", &RegionByLines::to_string);
  Record<LinesOptions> options(m, "LinesOptions", "Options of by_lines.");
  options.def(
      "__init__",
      [](LinesOptions* self, std::optional<double> tolerance, const SumOptions& sums) {
        new (self) LinesOptions{tolerance, sums};
      },
      "tolerance"_a = nb::none(), "sums"_a = SumOptions());
  options.option("tolerance", &LinesOptions::tolerance, "the most that a vertex may move; None: by the coordinates")
      .option("sums", &LinesOptions::sums, "of the union that makes the region");
  m.def(
      "by_lines",
      [](const std::vector<RegionData>& regions, const LinesOptions& options) {
        return run_with(options.sums, [&](const SumOptions& own) {
          return by_lines(regions, {options.tolerance, own});
        });
      },
      "regions"_a, "options"_a = LinesOptions(), "The same of several: what is parallel in two of them is so exactly.");
  m.def(
      "by_lines",
      [](const RegionDataArgument& data, const LinesOptions& options) {
        return run_with(options.sums, [&](const SumOptions& own) { return by_lines(*data, {options.tolerance, own}); });
      },
      "data"_a, "options"_a = LinesOptions(),
      R"doc(The region whose edges lie on the lines that they were meant to lie on, exactly: parallel, at right angles, and on
one line where those of the data are but for rounding. Raises Error: out_of_range for a tolerance that is too small;
no_area where nothing is left; not_finite; too_few_vertices; repeated_vertex; cancelled; out_of_memory.

>>> from math import cos, sin
>>> from dymsum import by_lines, minkowski_sum
>>> ell = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]
>>> part = by_lines([[(cos(1) * x - sin(1) * y, sin(1) * x + cos(1) * y) for x, y in ell]])
>>> minkowski_sum(part.region, part.region).vertex_count(), part.largest_move < 1e-11
(8, True)
)doc");
}

}  // namespace

void bind_planar_boolean(nb::module_& m) {
  bind_boolean_of_many<united>(
      m, "united",
      R"doc(What lies in one of the sets, exactly. Results are operands as they are: nothing is rounded in between.

>>> from dymsum import shapes, united
>>> united([shapes.rectangle(0, 0, 2, 2), shapes.rectangle(1, 1, 3, 3)]).area_exact()
Fraction(7, 1)
)doc");
  bind_boolean_of_many<intersection>(m, "intersection", "What lies in all of the sets, exactly; of at least one.");
  bind_boolean_of_two<united>(m, "united", "__or__",
                              "What lies in one of two sets, exactly. a | b is the same with Semantics.regular.");
  bind_boolean_of_two<intersection>(
      m, "intersection", "__and__",
      R"doc(What lies in both sets, exactly. Sets are closed: where they only touch, the result has segments and points. a & b is
the same with Semantics.regular, and has none.

>>> from dymsum import intersection, shapes
>>> both = intersection(shapes.rectangle(0, 0, 1, 1), shapes.rectangle(1, 0, 2, 1))
>>> len(both.parts), [(s.from_.at, s.to.at) for s in both.segments]
(0, [(Point(x=1.0, y=0.0), Point(x=1.0, y=1.0))])
)doc");
  bind_boolean_of_two<difference>(
      m, "difference", "__sub__",
      R"doc(What lies in the first set and not in the second, exactly. What is taken away is open, so the result is closed. a - b is
the same with Semantics.regular: parts with area alone.

>>> from dymsum import shapes
>>> (shapes.rectangle(0, 0, 4, 4) - shapes.rectangle(1, 1, 2, 2)).area_exact()
Fraction(15, 1)
)doc");
  bind_boolean_of_two<symmetric_difference>(
      m, "symmetric_difference", "__xor__",
      "What lies in one of two sets alone, exactly. a ^ b is the same with Semantics.regular.");
  m.def(
      "filled",
      [](const RegionDataArgument& rings, Fill fill, const SumOptions& options) {
        PlanarSum sum = run_with(options, [&](const SumOptions& own) { return filled(*rings, fill, own); });
        return remembered(std::move(sum), "filled", *rings, fill, options);
      },
      "rings"_a, "fill"_a = Fill::nonzero, "options"_a = SumOptions(),
      R"doc(What rings bound that may cross, touch or lie on themselves and each other, by winding number.

>>> from dymsum import Fill, filled
>>> bow = [[(0, 0), (2, 2), (2, 0), (0, 2)]]
>>> filled(bow, Fill.even_odd).area_exact(), filled(bow, Fill.positive).area_exact()
(Fraction(2, 1), Fraction(1, 1))
)doc");
  bind_fill_report(m);
  bind_by_lines(m);
}

}  // namespace dymsum::python

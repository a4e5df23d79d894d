// Boolean operations of regions and results.
#include "dymsum/planar_boolean.h"

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
}

}  // namespace dymsum::python

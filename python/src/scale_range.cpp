// The scales at which a part fits.
#include "dymsum/scale_range.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_range_results(nb::module_& m) {
  Record<ScaleContact> contact(m, "ScaleContact", "A contact of part and obstacle at one exact scale.");
  enumeration<ScaleContact::Kind>(contact, "Kind", "What touches what.");
  contact.listed();
  Record<ScaleInterval>(m, "ScaleInterval", "A closed interval of scales; low None: from 0 on, high None: without end.")
      .listed();
  Record<ScaleRange>(m, "ScaleRange", "An exact set of scales.")
      .listed()
      .def(
          "contains", [](const ScaleRange& self, const ScaleArgument& s) { return self.contains(s.value()); }, "s"_a)
      .def("trap", &ScaleRange::trap, "The scale up to which all smaller parts are free; None: never blocked.");
}

}  // namespace

void bind_scale_range(nb::module_& m) {
  bind_range_results(m);
  m.def(
      "scale_range",
      [](const RegionArgument& part, const std::vector<Point>& path, const RegionArgument& obstacles,
         const Progress& progress) {
        return run(progress, [&](Progress own) { return scale_range(*part, path, *obstacles, own); });
      },
      "part"_a, "path"_a, "obstacles"_a, "progress"_a = nb::none(),
      R"doc(The scales s for which s `part`, moved along the path, never overlaps the obstacles. Raises Error:
unsupported_operand, not_finite, cancelled.

>>> from dymsum import scale_range, shapes
>>> free = scale_range(shapes.rectangle(-1, -1, 1, 1), [(-9, 0), (9, 0)], shapes.rectangle(0, 3, 1, 4)).free
>>> [(interval.low, interval.high) for interval in free]
[(None, Fraction(3, 1))]
)doc");
  m.def(
      "fit_range",
      [](const RegionArgument& part, const RegionArgument& container, const Position<2>& at, const Progress& progress) {
        if (!at.exact) return take(Result<ScaleRange>(Error{ErrorCode::not_finite, "the placement is not finite", {}}));
        return run(progress, [&](Progress own) { return fit_range(*part, *container, *at.exact, own); });
      },
      "part"_a, "container"_a, "at"_a, "progress"_a = nb::none(),
      "The scales at which s `part`, placed at `at`, lies inside the container.");
  m.def(
      "fit_range",
      [](const RegionArgument& part, const RegionArgument& container, const Progress& progress) {
        return run(progress, [&](Progress own) { return fit_range(*part, *container, own); });
      },
      "part"_a, "container"_a, "progress"_a = nb::none(),
      R"doc(The scales at which s `part` lies inside the container at some translation.

>>> from dymsum import fit_range, shapes
>>> fit_range(shapes.rectangle(0, 0, 2, 1), shapes.rectangle(0, 0, 7, 3)).free[0].high
Fraction(3, 1)
)doc");
}

}  // namespace dymsum::python

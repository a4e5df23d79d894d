// Nesting instances, and inner fits of turned parts.
#include "dymsum/nesting.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/orientation_sum.h"
#include "paths.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_instance_records(nb::module_& m) {
  Record<NestingItem>(m, "NestingItem", "A kind of item, its shape as it stands in the file.")
      .field("name", &NestingItem::name)
      .field("shape", &NestingItem::shape, "RegionData, not yet validated")
      .field("demand", &NestingItem::demand, "How many are to be placed.")
      .field("degrees", &NestingItem::degrees,
             "The orientations that it may take, counter-clockwise, as fractions of a degree, exactly the decimal "
             "numbers of the file; None where it may take any.");
  Record<NestingBin>(m, "NestingBin", "A kind of bin.")
      .field("name", &NestingBin::name)
      .field("shape", &NestingBin::shape, "RegionData, not yet validated");
  Record<NestingInstance>(m, "NestingInstance", "Which items have to be placed, in which orientations, into what.")
      .field("name", &NestingInstance::name, "\"\" where the file has none")
      .field("items", &NestingInstance::items)
      .field("bins", &NestingInstance::bins)
      .field("strip_height", &NestingInstance::strip_height, "None where there is no strip");
}

void bind_instance_readers(nb::module_& m) {
  m.def(
      "read_nesting_instance", [](const PathArgument& path) { return take(read_nesting_instance(path.text)); },
      "path"_a,
      "The JSON of the nesting literature. Raises Error: cannot_open; malformed, truncated, not_finite with file and "
      "line.");
  m.def(
      "parse_nesting_instance",
      [](const std::string& text, const std::string& name) { return take(parse_nesting_instance(text, name)); },
      "text"_a, "name_for_errors"_a = "text", R"doc(The same from text.

>>> from dymsum import parse_nesting_instance
>>> instance = parse_nesting_instance('''{"items": [{"id": "bar", "allowed_orientations": [0, 22.5],
...   "shape": {"type": "rectangle", "data": {"x_min": 0, "y_min": 0, "width": 2, "height": 1}}}]}''')
>>> instance.items[0].name, instance.items[0].degrees
('bar', [Fraction(0, 1), Fraction(45, 2)])
)doc");
}

void bind_rotated_erode(nb::module_& m) {
  m.def(
      "rotated_erode",
      [](const RegionArgument& p, const RegionArgument& q, const Orientation& theta, const SumOptions& options) {
        PlanarSum fit = run_with(options, [&](const SumOptions& own) { return rotated_erode(*p, *q, theta, own); });
        return remembered(std::move(fit), "rotated_erode", p.object, q.object, theta, options);
      },
      "p"_a, "q"_a, "theta"_a, "options"_a = SumOptions(),
      R"doc(The inner fit P (-) R(theta) Q = { x : x + R(theta) Q inside P }, Q never rounded. Raises Error as erode.

>>> from dymsum import Orientation, rotated_erode, shapes
>>> fit = rotated_erode(shapes.rectangle(0, 0, 2, 3), shapes.rectangle(0, 0, 3, 2), Orientation.of(1, 1))
>>> fit.points[0].at
Point(x=2.0, y=0.0)
)doc");
}

}  // namespace

void bind_nesting(nb::module_& m) {
  bind_instance_records(m);
  bind_instance_readers(m);
  bind_rotated_erode(m);
}

}  // namespace dymsum::python

// All planar sums of an interval of scales as one object.
#include "dymsum/family.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/family_file.h"
#include "dymsum/scaling_family.h"
#include "enumeration.h"
#include "paths.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_family_options(nb::module_& m) {
  Record<FamilyOptions> options(m, "FamilyOptions", "Options of families of sums.");
  options.def(
      "__init__",
      [](FamilyOptions* self, MovingOperand moving, bool reflect_q, Semantics semantics, std::uint64_t structure_bytes,
         std::uint64_t memory, Progress progress) {
        new (self) FamilyOptions{moving, reflect_q, semantics, structure_bytes, memory, std::move(progress)};
      },
      "moving"_a = MovingOperand::p, "reflect_q"_a = false, "semantics"_a = Semantics::closed, "structure_bytes"_a = 0,
      "memory"_a = 0, "progress"_a = nb::none());
  options.option("moving", &FamilyOptions::moving)
      .option("reflect_q", &FamilyOptions::reflect_q, "P (+) -Q")
      .option("semantics", &FamilyOptions::semantics)
      .option("structure_bytes", &FamilyOptions::structure_bytes,
              "bytes of structures that are kept, other cells are computed from scratch; 0: all")
      .option("memory", &FamilyOptions::memory, "bytes that may be held while the family is made; 0: no limit")
      .option("progress", &FamilyOptions::progress);
}

void bind_family_records(nb::module_& m) {
  enumeration<FamilyFeature>(m, "FamilyFeature", "What a lifetime is of.");
  Record<Lifetime>(m, "Lifetime", "The cells in which a feature of the sum is there.").listed();
  Record<FamilyWork>(m, "FamilyWork", "What a family holds, and what it took.").listed();
}

ScalingFamily created_family(const RegionArgument& p, const RegionArgument& q, const ScaleArgument& low,
                             const ScaleArgument& high, const ScaleArgument& ratio, const FamilyOptions& options) {
  return run_with(options, [&](const FamilyOptions& own) {
    return ScalingFamily::create(*p, *q, low.value(), high.value(), ratio.value(), own);
  });
}

/// A sum that a family gives: it pickles with the family.
template <class Work>
Remembered<PlanarSum> sum_of(nb::handle_t<ScalingFamily> self, const char* function, Work&& work,
                             std::initializer_list<Scale> scales) {
  const ScalingFamily& family = *nb::inst_ptr<ScalingFamily>(self);
  PlanarSum sum = take(without_gil([&] { return work(family); }));
  nb::list list;
  for (const Scale& s : scales) list.append(s);
  return remembered(std::move(sum), function, nb::borrow(self), list);
}

void bind_family_sums(nb::class_<ScalingFamily>& type) {
  type.def(
          "at",
          [](nb::handle_t<ScalingFamily> self, const ScaleArgument& s) {
            const Scale at = s.value();
            return sum_of(self, "family_at", [&](const ScalingFamily& f) { return f.at(at); }, {at});
          },
          "s"_a,
          "The exact sum at a scale of the interval, with its tight features at events. Raises Error: bad_scale.")
      .def(
          "outer",
          [](nb::handle_t<ScalingFamily> self, const ScaleArgument& a, const ScaleArgument& b) {
            const Scale from = a.value(), to = b.value();
            return sum_of(self, "family_outer", [&](const ScalingFamily& f) { return f.outer(from, to); }, {from, to});
          },
          "a"_a, "b"_a, "What lies in the sum at some scale of [a, b]: exact, closed.")
      .def(
          "inner",
          [](nb::handle_t<ScalingFamily> self, const ScaleArgument& a, const ScaleArgument& b) {
            const Scale from = a.value(), to = b.value();
            return sum_of(self, "family_inner", [&](const ScalingFamily& f) { return f.inner(from, to); }, {from, to});
          },
          "a"_a, "b"_a, "What lies in the sum at every scale of [a, b]: the closure of its interior, exact.");
}

void bind_family_events(nb::class_<ScalingFamily>& type) {
  type.def("events", &ScalingFamily::events, "All events in order; cells lie between them.")
      .def(
          "changes",
          [](const ScalingFamily& self, const ScaleArgument& a, const ScaleArgument& b, EventChange change) {
            return self.changes(a.value(), b.value(), change);
          },
          "a"_a, "b"_a, "change"_a = EventChange::visible, "The events in [a, b] of this kind.")
      .def(
          "next",
          [](const ScalingFamily& self, const ScaleArgument& s, EventChange change) {
            return self.next(s.value(), change);
          },
          "s"_a, "change"_a = EventChange::visible, "The first event of this kind after s, or None.")
      .def(
          "locate", [](const ScalingFamily& self, const ScaleArgument& s) { return self.locate(s.value()); }, "s"_a,
          "The cell that a scale lies in, or the event that it is.")
      .def(
          "lifetimes", [](const ScalingFamily& self) { return take(without_gil([&] { return self.lifetimes(); })); },
          "Of all vertices, edges and holes. Raises Error: out_of_memory where structures are not all kept.")
      .def("work", &ScalingFamily::work);
}

void bind_family_class(nb::module_& m) {
  nb::class_<ScalingFamily> type(
      m, "ScalingFamily",
      R"doc(All sums s P (+) Q of an interval of scales: any of them at once, and what changes.

>>> from dymsum import EventChange, FamilyOptions, MovingOperand, ScalingFamily, shapes
>>> plate = "POLYGON((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 3 2, 3 1, 1 1))"
>>> options = FamilyOptions(moving=MovingOperand.q, reflect_q=True)  # a peg that scales, in a plate
>>> family = ScalingFamily(plate, shapes.rectangle(0, 0, 1, 0.5), 1, 4, options=options)
>>> [event.s for event in family.changes(1, 4, EventChange.topology)]
[Fraction(2, 1)]
>>> family.at(1.5).hole_count(), len(family.at(2).tight_points), family.at(2.5).hole_count()
(1, 1, 0)
>>> family.outer(1, 1.5).hole_count(), family.inner(1, 4).hole_count()
(1, 1)
)doc");
  Record<ScalingFamily::Location>(type, "Location", "A cell of a family, or one of its events.")
      .field("index", &ScalingFamily::Location::index)
      .field("event", &ScalingFamily::Location::event);
  type.def(
          "__init__",
          [](ScalingFamily* self, const RegionArgument& p, const RegionArgument& q, const ScaleArgument& low,
             const ScaleArgument& high, const ScaleArgument& ratio, const FamilyOptions& options) {
            new (self) ScalingFamily(created_family(p, q, low, high, ratio, options));
          },
          "p"_a, "q"_a, "low"_a, "high"_a, "ratio"_a = 1, "options"_a = FamilyOptions(),
          "Sums diag(s, ratio s) P (+) Q for s in [low, high]. Raises Error: bad_scale; unsupported_operand for "
          "polylines and points; cancelled; out_of_memory.")
      .def_static("create", &created_family, "p"_a, "q"_a, "low"_a, "high"_a, "ratio"_a = 1,
                  "options"_a = FamilyOptions())
      .def("p", &ScalingFamily::p, nb::rv_policy::reference_internal)
      .def("q", &ScalingFamily::q, nb::rv_policy::reference_internal)
      .def("options", &ScalingFamily::options)
      .def("low", &ScalingFamily::low)
      .def("high", &ScalingFamily::high)
      .def("ratio", &ScalingFamily::ratio)
      .def("__reduce__", [](const ScalingFamily& self) {
        return nb::make_tuple(nb::module_::import_("dymsum._core").attr("parse_family"),
                              nb::make_tuple(format_family(self), "pickle"));
      });
  bind_family_events(type);
  bind_family_sums(type);
}

}  // namespace

void bind_family(nb::module_& m) {
  bind_family_options(m);
  bind_family_records(m);
  bind_family_class(m);
  m.def("format_family", &format_family, "family"_a, "The family as text; nothing is rounded.");
  m.def(
      "parse_family", [](const std::string& text, const std::string& name) { return take(parse_family(text, name)); },
      "text"_a, "name_for_errors"_a = "text", "The family of such a text. Raises Error: truncated, malformed.");
  m.def(
      "read_family", [](const PathArgument& path) { return take(read_family(path.text)); }, "path"_a,
      "The family of a file, also a compressed one.");
}

}  // namespace dymsum::python

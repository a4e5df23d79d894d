// All planar sums of an interval of scales as one object.
#include "dymsum/family.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/family_file.h"
#include "dymsum/rotation_family.h"
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
      .def(
          "ring_ids",
          [](const ScalingFamily& self, const ScaleArgument& s) {
            const Scale at = s.value();
            return take(without_gil([&] { return self.ring_ids(at); }));
          },
          "s"_a, "Identities of the rings of at(s), part by part, outer ring first; 0 where a ring has none.")
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
          "Sums diag(s, ratio s) P (+) Q for s in [low, high]. Raises Error: bad_scale; unsupported_operand for huge "
          "coordinates; cancelled; out_of_memory.")
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

/// A sum of a turn: it pickles with the operands.
Remembered<PlanarSum> rotation_at(const RotationFamily& family, const Orientation& theta) {
  return remembered(take(without_gil([&] { return family.at(theta); })), "rotation_family_at", family.p(), family.q(),
                    family.options(), theta);
}

template <class Work>
Remembered<PlanarSum> turned_set(const char* function, Work&& work, const RegionArgument& p, const RegionArgument& q,
                                 const Orientation& a, const Orientation& b, double tolerance,
                                 const FamilyOptions& options) {
  PlanarSum sum = run_with(options, [&](const FamilyOptions& own) { return work(*p, *q, a, b, tolerance, own); });
  FamilyOptions own = options;
  own.progress = {};
  return remembered(std::move(sum), function, p.object, q.object, a, b, tolerance, own);
}

void bind_rotation_sets(nb::module_& m) {
  m.def(
      "outer_rotated_sum",
      [](const RegionArgument& p, const RegionArgument& q, const Orientation& a, const Orientation& b, double tolerance,
         const FamilyOptions& options) {
        return turned_set("outer_rotated_sum", outer_rotated_sum, p, q, a, b, tolerance, options);
      },
      "p"_a, "q"_a, "a"_a, "b"_a, "tolerance"_a, "options"_a = FamilyOptions(),
      "A set that holds the sums at all angles from a to b, within tolerance. Raises Error: out_of_range.");
  m.def(
      "inner_rotated_sum",
      [](const RegionArgument& p, const RegionArgument& q, const Orientation& a, const Orientation& b, double tolerance,
         const FamilyOptions& options) {
        return turned_set("inner_rotated_sum", inner_rotated_sum, p, q, a, b, tolerance, options);
      },
      "p"_a, "q"_a, "a"_a, "b"_a, "tolerance"_a, "options"_a = FamilyOptions(),
      "A set that lies in the sums at all angles from a to b. Raises Error: out_of_range.");
}

void bind_rotation_class(nb::module_& m) {
  nb::class_<RotationFamily> type(m, "RotationFamily",
                                  R"doc(All sums R(theta) P (+) Q of a whole rotation: any of them at once.

>>> from dymsum import Orientation, RotationFamily, shapes
>>> family = RotationFamily(shapes.rectangle(-2, -0.5, 2, 0.5), shapes.rectangle(0, 0, 1, 1))
>>> family.at(Orientation()).area_exact(), family.at(Orientation.parse("1/2")).vertex_count()
(Fraction(10, 1), 8)
>>> len(family.angles()), family.cell_of(Orientation()) is None
(4, True)
>>> outer = family.outer(Orientation(), Orientation.parse("1/8"), 0.05)
>>> outer.area() > family.at(Orientation()).area()
True
)doc");
  type.def(
          "__init__",
          [](RotationFamily* self, const RegionArgument& p, const RegionArgument& q, const FamilyOptions& options) {
            new (self) RotationFamily(
                run_with(options, [&](const FamilyOptions& own) { return RotationFamily::create(*p, *q, own); }));
          },
          "p"_a, "q"_a, "options"_a = FamilyOptions(),
          "The moving operand rotates about the origin. Raises Error: unsupported_operand for polylines and points; "
          "cancelled; out_of_memory.")
      .def_static(
          "create",
          [](const RegionArgument& p, const RegionArgument& q, std::optional<Point> centre,
             const FamilyOptions& options) {
            return run_with(options, [&](const FamilyOptions& own) {
              return centre ? RotationFamily::create(*p, *q, *centre, own) : RotationFamily::create(*p, *q, own);
            });
          },
          "p"_a, "q"_a, "centre"_a = nb::none(), "options"_a = FamilyOptions(),
          "About another point. Raises Error: also unsupported_operand where a vertex less that point is no double.")
      .def("p", &RotationFamily::p, nb::rv_policy::reference_internal)
      .def("q", &RotationFamily::q, nb::rv_policy::reference_internal)
      .def("options", &RotationFamily::options)
      .def("angles", &RotationFamily::angles, "The exact angles at which the sum changes, by increasing theta.")
      .def("work", &RotationFamily::work)
      .def("at", &rotation_at, "theta"_a, "The exact sum at an orientation, with its tight features.")
      .def("cell_of", &RotationFamily::cell_of, "theta"_a, "The cell; None at the angle of a change.")
      .def("next", &RotationFamily::next, "theta"_a, "The first angle of a change after theta, round the circle.")
      .def("lifetimes", &RotationFamily::lifetimes, "The edges of the boundary, by their contacts.")
      .def(
          "outer",
          [](const RotationFamily& self, const Orientation& a, const Orientation& b, double tolerance) {
            return remembered(take(without_gil([&] { return self.outer(a, b, tolerance); })), "outer_rotated_sum",
                              self.p(), self.q(), a, b, tolerance, self.options());
          },
          "a"_a, "b"_a, "tolerance"_a, "A set that holds the sums at all angles from a to b.")
      .def(
          "inner",
          [](const RotationFamily& self, const Orientation& a, const Orientation& b, double tolerance) {
            return remembered(take(without_gil([&] { return self.inner(a, b, tolerance); })), "inner_rotated_sum",
                              self.p(), self.q(), a, b, tolerance, self.options());
          },
          "a"_a, "b"_a, "tolerance"_a, "A set that lies in the sums at all angles from a to b.")
      .def("__reduce__", [](const RotationFamily& self) {
        return nb::make_tuple(nb::type<RotationFamily>(), nb::make_tuple(self.p(), self.q(), self.options()));
      });
}

}  // namespace

void bind_family(nb::module_& m) {
  bind_family_options(m);
  bind_family_records(m);
  bind_family_class(m);
  bind_rotation_class(m);
  bind_rotation_sets(m);
  m.def("format_family", &format_family, "family"_a, "The family as text; nothing is rounded.");
  m.def(
      "parse_family", [](const std::string& text, const std::string& name) { return take(parse_family(text, name)); },
      "text"_a, "name_for_errors"_a = "text", "The family of such a text. Raises Error: truncated, malformed.");
  m.def(
      "read_family", [](const PathArgument& path) { return take(read_family(path.text)); }, "path"_a,
      "The family of a file, also a compressed one.");
}

}  // namespace dymsum::python

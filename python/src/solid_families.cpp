// All sums of solids of an interval of scales, or of angles, as one object.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/solid_rotation_family.h"
#include "dymsum/solid_scaling_family.h"
#include "enumeration.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_solid_family_records(nb::module_& m) {
  enumeration<SolidFamilyFeature>(m, "SolidFamilyFeature", "What a lifetime of a family of solids is of.");
  Record<SolidFamilyLocation>(m, "SolidFamilyLocation", "A cell of a family, or one of its events.")
      .field("index", &SolidFamilyLocation::index)
      .field("event", &SolidFamilyLocation::event);
  Record<SolidLifetime>(m, "SolidLifetime", "The cells in which a feature of the sum is there.")
      .field("feature", &SolidLifetime::feature)
      .field("contact", &SolidLifetime::contact, "of a face")
      .field("shell", &SolidLifetime::shell, "of a shell, its identity")
      .field("first_cell", &SolidLifetime::first_cell)
      .field("last_cell", &SolidLifetime::last_cell);
  Record<SolidFamilyWork>(m, "SolidFamilyWork", "What a family of solids holds now, and what it took.")
      .field("events", &SolidFamilyWork::events)
      .field("visible", &SolidFamilyWork::visible, "those known to change the sum's structure")
      .field("cells", &SolidFamilyWork::cells)
      .field("kept", &SolidFamilyWork::kept, "cells whose structure is kept")
      .field("made", &SolidFamilyWork::made, "structures made so far, each by a sum from scratch")
      .field("bytes", &SolidFamilyWork::bytes, "of structures that are kept")
      .field("ms", &SolidFamilyWork::ms, "of the making");
  Record<SolidFamilyOptions> options(m, "SolidFamilyOptions", "Options of families of sums of solids.");
  options.def(
      "__init__",
      [](SolidFamilyOptions* self, MovingOperand moving, Semantics semantics, bool tight, int threads,
         std::uint64_t structure_bytes, Progress progress) {
        new (self) SolidFamilyOptions{moving, semantics, tight, threads, structure_bytes, std::move(progress)};
      },
      "moving"_a = MovingOperand::p, "semantics"_a = Semantics::closed, "tight"_a = true, "threads"_a = 1,
      "structure_bytes"_a = SolidFamilyOptions().structure_bytes, "progress"_a = nb::none());
  options.option("moving", &SolidFamilyOptions::moving, "the operand that scales or rotates")
      .option("semantics", &SolidFamilyOptions::semantics)
      .option("tight", &SolidFamilyOptions::tight, "look for tight features; False lists none")
      .option("threads", &SolidFamilyOptions::threads, "0: as many as there are cores")
      .option("structure_bytes", &SolidFamilyOptions::structure_bytes,
              "bytes of structures that are kept, others are made again; 0: no limit")
      .option("progress", &SolidFamilyOptions::progress, "of the making");
}

/// A family with its operands, by which its sums pickle.
template <class Family>
struct SolidFamily {
  nb::object p, q;
  Family family;
};
using Scaling = SolidFamily<SolidScalingFamily>;
using Rotating = SolidFamily<SolidRotationFamily>;

MovingSolidOptions sum_options(const SolidFamilyOptions& of) {
  MovingSolidOptions options;
  options.semantics = of.semantics, options.tight = of.tight;
  return options;
}

Scaling* made_scaling(const MeshArgument& p, const MeshArgument& q, const ScaleArgument& low, const ScaleArgument& high,
                      const SolidFamilyOptions& options) {
  return new Scaling{p.object, q.object, run_with(options, [&](const SolidFamilyOptions& own) {
                       return SolidScalingFamily::create(*p, *q, low.value(), high.value(), own);
                     })};
}

Remembered<SpatialSum> scaled_sum(const Scaling& self, const ScaleArgument& s, const Progress& progress) {
  const Scale at = s.value();
  SpatialSum sum = run(progress, [&](const Progress& own) { return self.family.at(at, own); });
  const SolidPose scaled{{}, {at, at, at}};
  const bool of_p = self.family.options().moving == MovingOperand::p;
  return remembered(std::move(sum), "posed_sum", self.p, self.q, of_p ? scaled : SolidPose{},
                    of_p ? SolidPose{} : scaled, sum_options(self.family.options()));
}

void bind_scaling_queries(nb::class_<Scaling>& type) {
  type.def("at", &scaled_sum, "s"_a, "progress"_a = nb::none(),
           "The exact sum at a scale of the interval, with its tight features at events. Raises Error: bad_scale.")
      .def(
          "events", [](const Scaling& self) { return self.family.events(); },
          "All events in order; cells lie between them.")
      .def(
          "changes",
          [](const Scaling& self, const ScaleArgument& a, const ScaleArgument& b, EventChange change) {
            return self.family.changes(a.value(), b.value(), change);
          },
          "a"_a, "b"_a, "change"_a = EventChange::visible, "The events in [a, b] of this kind.")
      .def(
          "next",
          [](const Scaling& self, const ScaleArgument& s, EventChange change) {
            return self.family.next(s.value(), change);
          },
          "s"_a, "change"_a = EventChange::visible, "The first event of this kind after s, or None.")
      .def(
          "locate", [](const Scaling& self, const ScaleArgument& s) { return self.family.locate(s.value()); }, "s"_a,
          "The cell that a scale lies in, or the event that it is.")
      .def(
          "volume_polynomial",
          [](const Scaling& self, const ScaleArgument& s, const Progress& progress) {
            const Scale at = s.value();
            return run(progress, [&](const Progress& own) { return self.family.volume_polynomial(at, own); });
          },
          "s"_a, "progress"_a = nb::none(),
          "The exact coefficients c of the volume c[0] + c[1] s + c[2] s^2 + c[3] s^3 in the cell of s.")
      .def(
          "lifetimes",
          [](const Scaling& self, const Progress& progress) {
            return run(progress, [&](const Progress& own) { return self.family.lifetimes(own); });
          },
          "progress"_a = nb::none(), "Of all faces and shells: a sum from scratch for every cell that is not kept.")
      .def("work", [](const Scaling& self) { return self.family.work(); });
}

void bind_scaling_family(nb::module_& m) {
  nb::class_<Scaling> type(
      m, "SolidScalingFamily",
      R"doc(All sums s P (+) Q of solids of an interval of scales: any of them at once, and what changes.

>>> from dymsum import EventChange, MovingOperand, SolidFamilyOptions, SolidScalingFamily, shapes, solids
>>> ell = solids.prism(shapes.letter_l(3, 2, 1).parts[0].outer, 1)
>>> family = SolidScalingFamily(ell, solids.box(0, 0, 0, 1, 1, 1), 1, 4)
>>> family.changes(1, 4), family.at(2).shells
([], 1)
>>> family.volume_polynomial(2)[3] == ell.volume_exact()
True
)doc");
  type.def(
          "__init__",
          [](Scaling* self, const MeshArgument& p, const MeshArgument& q, const ScaleArgument& low,
             const ScaleArgument& high, const SolidFamilyOptions& options) {
            std::unique_ptr<Scaling> made(made_scaling(p, q, low, high, options));
            new (self) Scaling(std::move(*made));
          },
          "p"_a, "q"_a, "low"_a, "high"_a, "options"_a = SolidFamilyOptions(),
          "Raises Error: bad_scale; unsupported_operand; out_of_range for threads below 0; cancelled.")
      .def_static("create", &made_scaling, nb::rv_policy::take_ownership, "p"_a, "q"_a, "low"_a, "high"_a,
                  "options"_a = SolidFamilyOptions())
      .def("p", [](const Scaling& self) { return self.p; })
      .def("q", [](const Scaling& self) { return self.q; })
      .def("options", [](const Scaling& self) { return self.family.options(); })
      .def("low", [](const Scaling& self) { return self.family.low(); })
      .def("high", [](const Scaling& self) { return self.family.high(); })
      .def("__reduce__", [](const Scaling& self) {
        return nb::make_tuple(nb::type<Scaling>(), nb::make_tuple(self.p, self.q, self.family.low(), self.family.high(),
                                                                  self.family.options()));
      });
  bind_scaling_queries(type);
}

Rotating* made_rotating(const MeshArgument& p, const MeshArgument& q, const TurnAxis& axis,
                        const std::optional<AxisTurn>& from, const std::optional<AxisTurn>& to,
                        const SolidFamilyOptions& options) {
  if (from.has_value() != to.has_value()) throw nb::value_error("give both ends of the interval of angles, or none");
  return new Rotating{p.object, q.object, run_with(options, [&](const SolidFamilyOptions& own) {
                        return from ? SolidRotationFamily::create(*p, *q, axis, *from, *to, own)
                                    : SolidRotationFamily::create(*p, *q, axis, own);
                      })};
}

nb::object end_of(const Rotating& self, std::size_t end) {
  return self.family.ends() ? nb::cast((*self.family.ends())[end]) : nb::none();
}

Remembered<SpatialSum> turned_sum(const Rotating& self, const AxisTurn& turn, const Progress& progress) {
  SpatialSum sum = run(progress, [&](const Progress& own) { return self.family.at(turn, own); });
  SolidRotationOptions options;
  options.moving = self.family.options().moving, options.tight = self.family.options().tight;
  return remembered(std::move(sum), "turned_solid_sum", self.p, self.q, self.family.axis(), options, turn);
}

void bind_rotation_family(nb::module_& m) {
  nb::class_<Rotating> type(m, "SolidRotationFamily",
                            R"doc(All sums R(theta) P (+) Q of solids about an axis: any of them at once.

>>> from fractions import Fraction
>>> from dymsum import AxisTurn, SolidRotationFamily, solids
>>> cube = solids.box(-1, -1, -1, 1, 1, 1)
>>> family = SolidRotationFamily(cube, cube, (0, 0, 1))
>>> len(family.events()), len(family.at(AxisTurn.of(Fraction(1, 3))).faces)
(4, 10)
)doc");
  type.def(
          "__init__",
          [](Rotating* self, const MeshArgument& p, const MeshArgument& q, const TurnAxis& axis,
             const std::optional<AxisTurn>& from, const std::optional<AxisTurn>& to,
             const SolidFamilyOptions& options) {
            std::unique_ptr<Rotating> made(made_rotating(p, q, axis, from, to, options));
            new (self) Rotating(std::move(*made));
          },
          "p"_a, "q"_a, "axis"_a, "from_"_a = nb::none(), "to"_a = nb::none(), "options"_a = SolidFamilyOptions(),
          "A whole turn, or from one turn counter-clockwise to another. Raises Error: as SolidRotationEvents; "
          "out_of_range where both are one; cancelled.")
      .def_static("create", &made_rotating, nb::rv_policy::take_ownership, "p"_a, "q"_a, "axis"_a,
                  "from_"_a = nb::none(), "to"_a = nb::none(), "options"_a = SolidFamilyOptions())
      .def("p", [](const Rotating& self) { return self.p; })
      .def("q", [](const Rotating& self) { return self.q; })
      .def("axis", [](const Rotating& self) { return self.family.axis(); })
      .def("options", [](const Rotating& self) { return self.family.options(); })
      .def(
          "ends", [](const Rotating& self) { return self.family.ends(); }, "From which turn to which one; None of all.")
      .def(
          "events", [](const Rotating& self) { return self.family.events(); },
          "All events in order; cells lie between them.")
      .def("at", &turned_sum, "theta"_a, "progress"_a = nb::none(),
           "The exact sum at a turn of the interval. Raises Error: bad_rotation outside of it.")
      .def(
          "next", [](const Rotating& self, const AxisTurn& turn) { return self.family.next(turn); }, "theta"_a,
          "The first event after a turn of the interval, or None. Raises ValueError outside of it.")
      .def(
          "locate", [](const Rotating& self, const AxisTurn& turn) { return self.family.locate(turn); }, "theta"_a,
          "The cell that a turn lies in, or the event that it is. Raises ValueError outside of the interval.")
      .def("work", [](const Rotating& self) { return self.family.work(); })
      .def("__reduce__", [](const Rotating& self) {
        return nb::make_tuple(nb::type<Rotating>(), nb::make_tuple(self.p, self.q, self.family.axis(), end_of(self, 0),
                                                                   end_of(self, 1), self.family.options()));
      });
}

}  // namespace

void bind_solid_families(nb::module_& m) {
  bind_solid_family_records(m);
  bind_scaling_family(m);
  bind_rotation_family(m);
}

}  // namespace dymsum::python

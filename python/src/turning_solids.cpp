// Events of a sum of solids while one of them turns about an axis.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/orientation.h"
#include "dymsum/solid_rotation_events.h"
#include "held.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// A SolidRotationEvents and what it was made of. Queries take a progress of their own.
struct TurningSolid {
  TurningSolid(const MeshArgument& p_of, const MeshArgument& q_of, const TurnAxis& about, const SolidRotationOptions& o)
      : p(p_of.object),
        q(q_of.object),
        axis(about),
        options(o),
        held(take(without_gil([&] { return SolidRotationEvents::create(*p_of, *q_of, about, o); }))) {}

  template <class F>
  auto ask(const Progress& progress, F query) {
    return held.alone(
        [&](SolidRotationEvents& sum) { return run(progress, [&](Progress own) { return query(sum, own); }); });
  }

  nb::object p, q;
  TurnAxis axis;
  SolidRotationOptions options;
  Held<SolidRotationEvents> held;
};

std::string text_of(const AxisTurn& turn) { return turn.is_half_turn() ? "inf" : turn.t().to_string(); }

void bind_axis_turn(nb::module_& m) {
  nb::class_<AxisTurn> turn(m, "AxisTurn", R"doc(A turn by theta about an axis, given by t = tan(theta / 2) / |axis|.

>>> import math
>>> from dymsum import AxisTurn
>>> AxisTurn.nearest((0, 0, 1), math.pi / 2).t()
Fraction(1, 1)
)doc");
  turn.def(nb::init<>())
      .def_static("of", &AxisTurn::of, "t"_a, "Any rational, exactly.")
      .def_static("half_turn", &AxisTurn::half_turn)
      .def_static(
          "nearest", [](const TurnAxis& axis, double radians) { return take(AxisTurn::nearest(axis, radians)); },
          "axis"_a, "radians"_a, "Within 2^-40 of the angle. Raises Error: bad_rotation.")
      .def_static(
          "nearest_degrees",
          [](const TurnAxis& axis, const Rational& degrees) {
            return take(AxisTurn::nearest(axis, reduced_degrees(degrees)));
          },
          "axis"_a, "degrees"_a, "The same of an angle in degrees.")
      .def("is_half_turn", &AxisTurn::is_half_turn)
      .def("t", &AxisTurn::t, "0 for half a turn.")
      .def("radians", &AxisTurn::radians, "axis"_a, "In (-pi, pi].")
      .def(
          "degrees", [](const AxisTurn& self, const TurnAxis& axis) { return in_degrees(self.radians(axis)); },
          "axis"_a, "In (-180, 180].")
      .def(
          "__eq__", [](const AxisTurn& a, const AxisTurn& b) { return a == b; }, nb::is_operator())
      .def("__repr__",
           [](const AxisTurn& self) {
             return self.is_half_turn() ? std::string("AxisTurn.half_turn()")
                                        : "AxisTurn.of(Fraction('" + self.t().to_string() + "'))";
           })
      .def("__getstate__",
           [](const AxisTurn& self) { return nb::make_tuple(self.is_half_turn() ? nb::none() : nb::cast(self.t())); })
      .def("__setstate__", [](AxisTurn& self, nb::tuple state) {
        new (&self) AxisTurn(state[0].is_none() ? AxisTurn::half_turn() : AxisTurn::of(nb::cast<Rational>(state[0])));
      });
  turn.def("__hash__", [](const AxisTurn& self) { return nb::hash(nb::cast(text_of(self))); });
}

void bind_events(nb::module_& m) {
  Record<SolidRotationContact> contact(m, "SolidRotationContact", "Features that come together at an event.");
  contact.attr("Kind") = m.attr("EventKind");
  contact.field("kind", &SolidRotationContact::kind)
      .field("features", &SolidRotationContact::features)
      .field("at", &SolidRotationContact::at, "where, rounded");
  Record<AlgebraicTurn>(m, "AlgebraicTurn", "An angle whose t is a root of a polynomial.")
      .field("exact", &AlgebraicTurn::exact, "where t is rational")
      .field("polynomial", &AlgebraicTurn::polynomial, "of which t is a root between t_low and t_high")
      .field("t_low", &AlgebraicTurn::t_low)
      .field("t_high", &AlgebraicTurn::t_high)
      .field("opposite", &AlgebraicTurn::opposite, "t is that of the angle less half a turn");
  Record<SolidRotationEvent> event(m, "SolidRotationEvent",
                                   "An angle at which something meets on the boundary of the sum.");
  event.field("parameter", &SolidRotationEvent::parameter, "the exact angle")
      .field("radians", &SolidRotationEvent::approx, "in (-pi, pi]")
      .field("kind", &SolidRotationEvent::kind, "the last of those of the contacts")
      .field("contacts", &SolidRotationEvent::contacts)
      .field("visible", &SolidRotationEvent::visible, "the sum's structure changes")
      .field("topology", &SolidRotationEvent::topology, "so do shells, tunnels or tight features");
  event
      .def_prop_ro(
          "exact", [](const SolidRotationEvent& e) { return e.parameter.exact; }, "where t is rational")
      .def_prop_ro("polynomial", [](const SolidRotationEvent& e) { return e.parameter.polynomial; })
      .def_prop_ro("t_low", [](const SolidRotationEvent& e) { return e.parameter.t_low; })
      .def_prop_ro("t_high", [](const SolidRotationEvent& e) { return e.parameter.t_high; })
      .def_prop_ro("opposite", [](const SolidRotationEvent& e) { return e.parameter.opposite; });
  Record<SolidRotationOptions> options(m, "SolidRotationOptions", "Options of SolidRotationEvents.");
  options.def(
      "__init__",
      [](SolidRotationOptions* self, MovingOperand moving, bool changes, double window, bool tight, int threads) {
        new (self) SolidRotationOptions{moving, changes, window, tight, threads};
      },
      "moving"_a = MovingOperand::p, "changes"_a = true, "window"_a = 0.0, "tight"_a = true, "threads"_a = 1);
  options.option("moving", &SolidRotationOptions::moving, "the operand that turns")
      .option("changes", &SolidRotationOptions::changes, "compare sums beside every event")
      .option("window", &SolidRotationOptions::window, "how far windows reach, in radians; 0: chosen")
      .option("tight", &SolidRotationOptions::tight, "look for tight features")
      .option("threads", &SolidRotationOptions::threads, "of sums; 0: as many as there are cores");
  Record<SolidRotationWork>(m, "SolidRotationWork", "The work of the last query.")
      .field("windows", &SolidRotationWork::windows)
      .field("facets", &SolidRotationWork::facets)
      .field("candidates", &SolidRotationWork::candidates, "whose polynomials were made")
      .field("roots", &SolidRotationWork::roots, "at which the features do meet")
      .field("covered", &SolidRotationWork::covered, "of these, proved to be covered by doubles")
      .field("exact_tests", &SolidRotationWork::exact_tests, "of these, tested exactly")
      .field("events", &SolidRotationWork::events)
      .field("sums", &SolidRotationWork::sums)
      .field("ms", &SolidRotationWork::ms);
}

void bind_queries(nb::class_<TurningSolid>& type) {
  type.def(
          "at",
          [](TurningSolid& self, const AxisTurn& turn, const Progress& progress) {
            return remembered(self.ask(progress, [&](SolidRotationEvents& s, Progress own) { return s.at(turn, own); }),
                              "turned_solid_sum", self.p, self.q, self.axis, self.options, turn);
          },
          "turn"_a, "progress"_a = nb::none(), "The exact sum at a turn.")
      .def(
          "events",
          [](TurningSolid& self, const AxisTurn& a, const AxisTurn& b, const Progress& progress) {
            return self.ask(progress, [&](SolidRotationEvents& s, Progress own) { return s.events(a, b, own); });
          },
          "a"_a, "b"_a, "progress"_a = nb::none(), "From a counter-clockwise to b, both included, in order.")
      .def(
          "events_of_turn",
          [](TurningSolid& self, const Progress& progress) {
            return self.ask(progress, [&](SolidRotationEvents& s, Progress own) { return s.events_of_turn(own); });
          },
          "progress"_a = nb::none(), "Those of a whole turn, from -pi (excluded) to pi.")
      .def(
          "next_event",
          [](TurningSolid& self, const AxisTurn& a, const AxisTurn& limit, const Progress& progress) {
            return self.ask(progress,
                            [&](SolidRotationEvents& s, Progress own) { return s.next_event(a, limit, own); });
          },
          "a"_a, "limit"_a, "progress"_a = nb::none(), "The first visible event behind a, or None.")
      .def(
          "next_topology_change",
          [](TurningSolid& self, const AxisTurn& a, const AxisTurn& limit, const Progress& progress) {
            return self.ask(
                progress, [&](SolidRotationEvents& s, Progress own) { return s.next_topology_change(a, limit, own); });
          },
          "a"_a, "limit"_a, "progress"_a = nb::none(), "The first that changes shells, tunnels or what is tight.");
}

void bind_class(nb::module_& m) {
  nb::class_<TurningSolid> type(m, "SolidRotationEvents",
                                R"doc(R(theta) P (+) Q about an axis: the exact angles at which it changes.

>>> from dymsum import AxisTurn, SolidRotationEvents, solids
>>> box = solids.box(-1, -1, -1, 1, 1, 1)
>>> sum = SolidRotationEvents(box, box, (0, 0, 1))
>>> [(e.exact.t(), e.visible) for e in sum.events(AxisTurn.of(-0.5), AxisTurn.of(1))]
[(Fraction(0, 1), True), (Fraction(1, 1), True)]
)doc");
  type.def(nb::init<const MeshArgument&, const MeshArgument&, const TurnAxis&, const SolidRotationOptions&>(), "p"_a,
           "q"_a, "axis"_a, "options"_a = SolidRotationOptions())
      .def_static(
          "create",
          [](const MeshArgument& p, const MeshArgument& q, const TurnAxis& axis, const SolidRotationOptions& options) {
            return new TurningSolid(p, q, axis, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "axis"_a, "options"_a = SolidRotationOptions(),
          "Raises Error: unsupported_operand, bad_rotation, out_of_range.")
      .def("axis", [](TurningSolid& self) { return self.held.alone([](SolidRotationEvents& s) { return s.axis(); }); })
      .def(
          "combinatorial_hash",
          [](TurningSolid& self, const SpatialSum& sum) {
            return self.held.alone([&](SolidRotationEvents& s) { return s.combinatorial_hash(sum); });
          },
          "sum"_a, "Of the structure of a sum at a turn; constant between consecutive events.")
      .def("work", [](TurningSolid& self) { return self.held.alone([](SolidRotationEvents& s) { return s.work(); }); })
      .def_prop_ro("options", [](const TurningSolid& self) { return self.options; })
      .def("__reduce__", [](nb::handle_t<TurningSolid> self) {
        const auto* object = nb::inst_ptr<TurningSolid>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(object->p, object->q, object->axis, object->options));
      });
  bind_queries(type);
}

}  // namespace

void bind_turning_solids(nb::module_& m) {
  bind_axis_turn(m);
  bind_events(m);
  bind_class(m);
}

}  // namespace dymsum::python

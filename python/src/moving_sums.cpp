// Planar sums that follow a scale or an orientation.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "enumeration.h"
#include "held.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// A ScalingSum or a RotatingSum, its operands and options, and the watch whose Progress it keeps.
template <class Sum>
struct Moving {
  Moving(const RegionArgument& p_of, const RegionArgument& q_of, const MovingOptions& o)
      : p(p_of.object), q(q_of.object), options(own_options(o)), watch(options.progress), held(create(*p_of, *q_of)) {}

  static MovingOptions own_options(MovingOptions options) {
    options.progress = own_progress(options.progress);
    return options;
  }
  Sum create(const Region& p_of, const Region& q_of) {
    MovingOptions own = options;
    own.progress = watch.progress();
    return watch.take(without_gil([&] { return Sum::create(p_of, q_of, own); }));
  }
  /// The value of work(sum), a Result, without the GIL.
  template <class Work>
  auto run(Work&& work) {
    return held.alone([&](Sum& sum) {
      watch.begin();
      return watch.take(without_gil([&] { return work(sum); }));
    });
  }
  /// What work(sum) tells at once.
  template <class Work>
  auto report(Work&& work) {
    return held.alone(work);
  }

  nb::object p, q;
  MovingOptions options;
  Watch watch;
  Held<Sum> held;
};

using Scaling = Moving<ScalingSum>;
using Rotating = Moving<RotatingSum>;

template <class Self, class Sum>
void bind_common(nb::class_<Self>& type) {
  type.def(
          "__init__",
          [](Self* self, const RegionArgument& p, const RegionArgument& q, const MovingOptions& options) {
            new (self) Self(p, q, options);
          },
          "p"_a, "q"_a, "options"_a = MovingOptions())
      .def_static(
          "create",
          [](const RegionArgument& p, const RegionArgument& q, const MovingOptions& options) {
            return new Self(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = MovingOptions(),
          "At rest. Raises Error: unsupported_operand for coordinates beyond 2^1000; cancelled.")
      .def(
          "ring_ids", [](Self& self) { return self.report([](const Sum& sum) { return sum.ring_ids(); }); },
          "Identities of the rings of sum(), part by part, outer ring first.")
      .def(
          "work", [](Self& self) { return self.report([](const Sum& sum) { return sum.work(); }); },
          "The work of the last frame.")
      .def_prop_ro("options", [](const Self& self) { return Self::own_options(self.options); });
}

void bind_event(nb::module_& m) {
  Record<ScaleEvent> event(m, "ScaleEvent", "An exact scale at which something meets on the boundary of a sum.");
  event.attr("Kind") = enumeration<EventKind>(m, "EventKind", "What meets at an event.");
  event.field("s", &ScaleEvent::parameter)
      .field("approx", &ScaleEvent::approx)
      .field("kind", &ScaleEvent::kind)
      .field("visible", &ScaleEvent::visible, "the sum's structure changes")
      .field("topology", &ScaleEvent::topology, "so do counts of parts, holes, shells or tight features, or a genus");
  enumeration<EventChange>(m, "EventChange", "What an event has to change to be looked for.");
}

/// ScalingSum with the scales it was last set to.
struct ScalingObject : Scaling {
  using Scaling::Scaling;
  std::array<Scale, 2> scales;
};

nb::object set_scales(ScalingObject& self, const Scale& sx, const Scale& sy) {
  FrameChanges changes = self.run([&](ScalingSum& sum) { return sx == sy ? sum.set(sx) : sum.set(sx, sy); });
  self.scales = {sx, sy};
  return nb::cast(std::move(changes));
}

void bind_scaling(nb::module_& m) {
  nb::class_<ScalingObject> type(m, "ScalingSum",
                                 R"doc(P (+) Q with one operand scaled about the origin: it follows the scale, exactly.

>>> from dymsum import ScalingSum, Scale, shapes
>>> sum = ScalingSum(shapes.star(5, 1, 2), shapes.rectangle(0, 0, 1, 1))
>>> changes = sum.set(Scale.parse("1.25"))
>>> sum.scale().exact(), sum.sum().vertex_count()
(Fraction(5, 4), 17)
>>> [float(event.s) for event in sum.events(1, 4) if event.topology]
[]
)doc",
                                 nb::type_slots(WatchedSlots<ScalingObject>::slots));
  bind_common<ScalingObject, ScalingSum>(type);
  type.def(
          "set", [](ScalingObject& self, const ScaleArgument& s) { return set_scales(self, s.value(), s.value()); },
          "s"_a, nb::sig("def set(self, s: Scale | fractions.Fraction | float) -> FrameChanges"),
          "Moves to a scale. Raises Error: bad_scale, not_finite, cancelled; nothing changes then.")
      .def(
          "set",
          [](ScalingObject& self, const ScaleArgument& sx, const ScaleArgument& sy) {
            return set_scales(self, sx.value(), sy.value());
          },
          "sx"_a, "sy"_a,
          nb::sig("def set(self, sx: Scale | fractions.Fraction | float, sy: Scale | fractions.Fraction | float) -> "
                  "FrameChanges"),
          "diag(sx, sy) times the scaled operand.")
      .def("scale", [](ScalingObject& self) { return self.report([](const ScalingSum& sum) { return sum.scale(); }); })
      .def(
          "sum",
          [](ScalingObject& self) {
            return self.report([&](const ScalingSum& sum) {
              return remembered(sum.sum(), "scaling_sum", self.p, self.q, self.options, self.scales[0], self.scales[1]);
            });
          },
          "A copy of the exact sum at the current scale.")
      .def("combinatorial_hash", [](ScalingObject& self) {
        return self.report([](const ScalingSum& sum) { return sum.combinatorial_hash(); });
      });
  type.def(
          "events",
          [](ScalingObject& self, const ScaleArgument& a, const ScaleArgument& b, const Progress& progress) {
            return self.report([&](const ScalingSum& sum) {
              return run(progress, [&](Progress own) { return sum.events(a.value(), b.value(), own); });
            });
          },
          "a"_a, "b"_a, "progress"_a = nb::none(), "The events in [a, b] in order. Raises Error: bad_scale; cancelled.")
      .def(
          "next_event",
          [](ScalingObject& self, const ScaleArgument& s, const ScaleArgument& limit, EventChange change,
             const Progress& progress) {
            return self.report([&](const ScalingSum& sum) {
              return run(progress, [&](Progress own) { return sum.next_event(s.value(), limit.value(), change, own); });
            });
          },
          "s"_a, "limit"_a, "change"_a = EventChange::visible, "progress"_a = nb::none(),
          "The first event of the kind asked for after s and at most `limit`, or None.")
      .def("__reduce__", [](nb::handle_t<ScalingObject> self) {
        const auto* object = nb::inst_ptr<ScalingObject>(self);
        return nb::make_tuple(
            nb::module_::import_("dymsum._remake").attr("scaling"),
            nb::make_tuple(object->p, object->q, object->options, object->scales[0], object->scales[1]));
      });
}

void bind_rotating(nb::module_& m) {
  nb::class_<Rotating> type(m, "RotatingSum", R"doc(R(theta) P (+) Q: it follows the orientation, exactly.

>>> from dymsum import Orientation, RotatingSum, shapes
>>> sum = RotatingSum(shapes.letter_l(3, 2, 1), shapes.disc(8, 0.5))
>>> changes = sum.set(Orientation.nearest(0.01))
>>> sum.sum().vertex_count(), sum.work().rebuilt
(16, False)
)doc",
                            nb::type_slots(WatchedSlots<Rotating>::slots));
  bind_common<Rotating, RotatingSum>(type);
  type.def(
          "set",
          [](Rotating& self, const Orientation& theta) {
            return self.run([&](RotatingSum& sum) { return sum.set(theta); });
          },
          "theta"_a, "Turns to an orientation. Raises Error: cancelled; nothing changes then.")
      .def("orientation",
           [](Rotating& self) { return self.report([](const RotatingSum& sum) { return sum.orientation(); }); })
      .def(
          "sum",
          [](Rotating& self) {
            return self.report([&](const RotatingSum& sum) {
              return remembered(sum.sum(), "rotating_sum", self.p, self.q, self.options, sum.orientation());
            });
          },
          "A copy of the exact sum at the current orientation.")
      .def("__reduce__", [](nb::handle_t<Rotating> self) {
        const auto* object = nb::inst_ptr<Rotating>(self);
        return nb::make_tuple(nb::module_::import_("dymsum._remake").attr("rotating"),
                              nb::make_tuple(object->p, object->q, object->options, self.attr("orientation")()));
      });
}

void bind_copies(nb::module_& m) {
  Record<ScaledCopy>(m, "ScaledCopy", "One copy of a master shape: scaled about its origin, then moved.")
      .constructible()
      .field("scale", &ScaledCopy::scale)
      .field("at", &ScaledCopy::at);
  Record<CopySum>(m, "CopySum", "The sum of a copy, not moved.")
      .field("sum", &CopySum::sum)
      .field("at", &CopySum::at, "add it to every position")
      .field("work", &CopySum::work);
  m.def(
      "scaled_copies",
      [](const RegionArgument& master, const RegionArgument& q, const std::vector<ScaledCopy>& copies,
         const MovingOptions& options) {
        return run_with(options, [&](const MovingOptions& own) { return scaled_copies(*master, *q, copies, own); });
      },
      "master"_a, "q"_a, "copies"_a, "options"_a = MovingOptions(),
      "s_i P (+) Q for every copy s_i P + z_i of an environment, in the order given.");
}

}  // namespace

void bind_moving_sums(nb::module_& m) {
  bind_event(m);
  bind_scaling(m);
  bind_rotating(m);
  bind_copies(m);
}

}  // namespace dymsum::python

// Sums of solids while one scales: events, scale ranges, copies.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/solid_scale_events.h"
#include "dymsum/solid_scale_range.h"
#include "held.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

struct ScalingSolid {
  ScalingSolid(const MeshArgument& p_of, const MeshArgument& q_of, const SolidScaleOptions& o)
      : p(p_of.object), q(q_of.object), options(o), held(create(*p_of, *q_of)) {}

  SolidScaleEvents create(const Mesh& p_of, const Mesh& q_of) const {
    return run(Progress(), [&](const Progress&) { return SolidScaleEvents::create(p_of, q_of, options); });
  }
  /// The value of work(sum, progress), a Result, without the GIL.
  template <class Work>
  auto ask(const Progress& progress, Work&& work) {
    return held.alone([&](const SolidScaleEvents& sum) {
      return run(progress, [&](const Progress& own) { return work(sum, own); });
    });
  }
  nb::object p, q;
  SolidScaleOptions options;
  Held<SolidScaleEvents> held;
};

void bind_event_options(nb::module_& m) {
  Record<SolidEventWork>(m, "SolidEventWork", "How events were found.")
      .field("candidates", &SolidEventWork::candidates)
      .field("exact", &SolidEventWork::exact)
      .field("points", &SolidEventWork::points)
      .field("values", &SolidEventWork::values)
      .field("sums", &SolidEventWork::sums, "computed to compare them");
  Record<SolidScaleOptions> options(m, "SolidScaleOptions", "Options of sums of solids one of which scales.");
  options.def(
      "__init__",
      [](SolidScaleOptions* self, MovingOperand moving, Semantics semantics, bool tight, int threads) {
        new (self) SolidScaleOptions{moving, semantics, tight, threads};
      },
      "moving"_a = MovingOperand::q, "semantics"_a = Semantics::closed, "tight"_a = true, "threads"_a = 1);
  options.option("moving", &SolidScaleOptions::moving, "which operand scales")
      .option("semantics", &SolidScaleOptions::semantics)
      .option("tight", &SolidScaleOptions::tight, "look for tight features; False lists none")
      .option("threads", &SolidScaleOptions::threads, "0: as many as there are cores");
}

void bind_sum(nb::module_& m) {
  nb::class_<ScalingSolid> type(m, "SolidScaleEvents",
                                R"doc(P (+) s Q of solids of any shape, with its events.

>>> from dymsum import SolidScaleEvents, shapes, solids
>>> ell = solids.prism(shapes.letter_l(3, 2, 1).parts[0].outer, 1)
>>> sum = SolidScaleEvents(ell, solids.box(0, 0, 0, 1, 1, 1))
>>> sum.events(1, 2), sum.at(2).shells
([], 1)
)doc");
  type.def(
          "__init__",
          [](ScalingSolid* self, const MeshArgument& p, const MeshArgument& q, const SolidScaleOptions& options) {
            new (self) ScalingSolid(p, q, options);
          },
          "p"_a, "q"_a, "options"_a = SolidScaleOptions())
      .def_static(
          "create",
          [](const MeshArgument& p, const MeshArgument& q, const SolidScaleOptions& options) {
            return new ScalingSolid(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = SolidScaleOptions(),
          "Raises Error: unsupported_operand; out_of_range for threads below 0.")
      .def("facet_count",
           [](ScalingSolid& self) { return self.held.alone([](SolidScaleEvents& s) { return s.facet_count(); }); })
      .def(
          "at",
          [](ScalingSolid& self, const ScaleArgument& s, const Progress& progress) {
            const Scale at = s.value();
            SolidPose pose[2];
            pose[self.options.moving == MovingOperand::p ? 0 : 1].scale = {at, at, at};
            MovingSolidOptions options;
            options.semantics = self.options.semantics, options.tight = self.options.tight;
            return remembered(
                self.ask(progress, [&](const SolidScaleEvents& sum, const Progress& own) { return sum.at(at, own); }),
                "posed_sum", self.p, self.q, pose[0], pose[1], options);
          },
          "s"_a, "progress"_a = nb::none(), "The exact sum at a scale, that of an event included.")
      .def(
          "events",
          [](ScalingSolid& self, const ScaleArgument& a, const ScaleArgument& b, const Progress& progress) {
            const Scale low = a.value(), high = b.value();
            return self.ask(
                progress, [&](const SolidScaleEvents& sum, const Progress& own) { return sum.events(low, high, own); });
          },
          "a"_a, "b"_a, "progress"_a = nb::none(), "All events in [a, b] in order. Raises Error: bad_scale, cancelled.")
      .def(
          "next_event",
          [](ScalingSolid& self, const ScaleArgument& s, const ScaleArgument& limit, EventChange change,
             const Progress& progress) {
            const Scale low = s.value(), high = limit.value();
            return self.ask(progress, [&](const SolidScaleEvents& sum, const Progress& own) {
              return sum.next_event(low, high, change, own);
            });
          },
          "s"_a, "limit"_a, "change"_a = EventChange::visible, "progress"_a = nb::none(),
          "The first event after s and at most `limit`; None where there is none.")
      .def(
          "next_topology_change",
          [](ScalingSolid& self, const ScaleArgument& s, const ScaleArgument& limit, const Progress& progress) {
            const Scale low = s.value(), high = limit.value();
            return self.ask(progress, [&](const SolidScaleEvents& sum, const Progress& own) {
              return sum.next_topology_change(low, high, own);
            });
          },
          "s"_a, "limit"_a, "progress"_a = nb::none(), "The first one that changes shells, genus or tight features.")
      .def(
          "combinatorial_hash",
          [](ScalingSolid& self, const ScaleArgument& s, const Progress& progress) {
            const Scale at = s.value();
            return self.ask(progress, [&](const SolidScaleEvents& sum, const Progress& own) {
              return sum.combinatorial_hash(at, own);
            });
          },
          "s"_a, "progress"_a = nb::none(), "Constant between consecutive events.")
      .def_prop_ro("options", [](const ScalingSolid& self) { return self.options; })
      .def("__reduce__", [](nb::handle_t<ScalingSolid> self) {
        const auto* object = nb::inst_ptr<ScalingSolid>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(object->p, object->q, object->options));
      });
}

void bind_solid_ranges(nb::module_& m) {
  Record<SolidScaleContact>(m, "SolidScaleContact", "A contact of part and obstacle at one exact scale.").listed();
  Record<SolidScaleInterval>(m, "SolidScaleInterval",
                             "A closed interval of scales; low None: from 0 on, high None: without end.")
      .listed();
  Record<SolidScaleRange>(m, "SolidScaleRange", "An exact set of scales.")
      .listed()
      .def(
          "contains", [](const SolidScaleRange& self, const ScaleArgument& s) { return self.contains(s.value()); },
          "s"_a)
      .def("trap", &SolidScaleRange::trap, "The scale up to which all smaller parts are free; None: never blocked.");
  m.def(
      "solid_scale_range",
      [](const MeshArgument& part, const std::vector<Point3>& path, const MeshArgument& obstacles,
         const Progress& progress) {
        return run(progress, [&](Progress own) { return solid_scale_range(*part, path, *obstacles, own); });
      },
      "part"_a, "path"_a, "obstacles"_a, "progress"_a = nb::none(),
      "The scales s for which s `part`, moved along the path, never overlaps the obstacles.");
  m.def(
      "solid_fit_range",
      [](const MeshArgument& part, const MeshArgument& container, const Position<3>& at, const Progress& progress) {
        if (!at.exact)
          return take(Result<SolidScaleRange>(Error{ErrorCode::not_finite, "the placement is not finite", {}}));
        return run(progress, [&](Progress own) { return solid_fit_range(*part, *container, *at.exact, own); });
      },
      "part"_a, "container"_a, "at"_a, "progress"_a = nb::none(),
      "The scales at which s `part`, placed at `at`, lies inside the container.");
  m.def(
      "solid_fit_range",
      [](const MeshArgument& part, const MeshArgument& container, const Progress& progress) {
        return run(progress, [&](Progress own) { return solid_fit_range(*part, *container, own); });
      },
      "part"_a, "container"_a, "progress"_a = nb::none(),
      "The scales at which s `part` lies inside the container at some translation.");
}

void bind_solid_copies(nb::module_& m) {
  Record<ScaledSolidCopy>(m, "ScaledSolidCopy", "One copy of a master solid: scaled about its origin, then moved.")
      .constructible()
      .field("scale", &ScaledSolidCopy::scale)
      .field("at", &ScaledSolidCopy::at);
  Record<SolidCopySum>(m, "SolidCopySum", "The sum of a copy, not moved.")
      .field("sum", &SolidCopySum::sum)
      .field("at", &SolidCopySum::at, "add it to every position");
  m.def(
      "scaled_solid_copies",
      [](const MeshArgument& master, const MeshArgument& q, const std::vector<ScaledSolidCopy>& copies,
         const Progress& progress) {
        return run(progress, [&](Progress own) { return scaled_solid_copies(*master, *q, copies, own); });
      },
      "master"_a, "q"_a, "copies"_a, "progress"_a = nb::none(),
      "s_i P (+) Q for every copy s_i P + z_i of an environment, in the order given.");
}

}  // namespace

void bind_scaling_solids(nb::module_& m) {
  bind_event_options(m);
  bind_sum(m);
  bind_solid_ranges(m);
  bind_solid_copies(m);
}

}  // namespace dymsum::python

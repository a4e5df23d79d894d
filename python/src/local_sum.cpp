// Sums of solids near a position.
#include "dymsum/local_sum.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "enumeration.h"
#include "held.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// A LocalSum, its operands and options, and the watch whose Progress it keeps.
struct Local {
  Local(const MeshArgument& p_of, const MeshArgument& q_of, const LocalOptions& o)
      : p(p_of.object), q(q_of.object), options(o), watch(o.progress), held(create(*p_of, *q_of)) {}

  LocalSum create(const Mesh& p_of, const Mesh& q_of) {
    LocalOptions own = options;
    own.progress = watch.progress();
    return watch.take(without_gil([&] { return LocalSum::create(p_of, q_of, own); }));
  }
  template <class Clip>
  Remembered<LocalPart> in(const Clip& clip, const SolidPose& p_pose, const SolidPose& q_pose) {
    LocalPart part = held.alone([&](LocalSum& sum) {
      watch.begin();
      return watch.take(without_gil([&] { return sum.in(clip, p_pose, q_pose); }));
    });
    return remembered(std::move(part), "local_part", p, q, options, clip, p_pose, q_pose);
  }

  nb::object p, q;
  LocalOptions options;
  Watch watch;
  Held<LocalSum> held;
};

void bind_positions(nb::module_& m) {
  Record<ClipBox> box(m, "ClipBox", "The closed box from `low` to `high`, in the unit of the coordinates.");
  box.def(
      "__init__",
      [](ClipBox* self, const Point3& low, const Point3& high) {
        new (self) ClipBox{low, high};
      },
      "low"_a, "high"_a);
  box.field("low", &ClipBox::low).field("high", &ClipBox::high);
  Record<ClipBall> ball(m, "ClipBall", "A closed ball: it selects faces, its bounding box cuts them.");
  ball.def(
      "__init__",
      [](ClipBall* self, const Point3& centre, double radius) {
        new (self) ClipBall{centre, radius};
      },
      "centre"_a, "radius"_a);
  ball.field("centre", &ClipBall::centre).field("radius", &ClipBall::radius);
  m.def(
      "bounding_box", [](const ClipBall& of) { return bounding_box(of); }, "ball"_a,
      "The smallest box of doubles that holds the ball.");
}

void bind_local_options(nb::module_& m) {
  enumeration<LocalEngine>(m, "LocalEngine", "How the facets near a place are found; all give the same part.",
                           {"those of the last call are brought to the new poses",
                            "by bounding spheres over pairs of features, at every call",
                            "the whole sum, every cell tested by itself, then cut: the reference"});
  Record<LocalOptions> options(m, "LocalOptions", "Options of LocalSum.");
  options.def(
      "__init__",
      [](LocalOptions* self, LocalEngine engine, bool tight, int threads, Progress progress) {
        new (self) LocalOptions{engine, tight, threads, std::move(progress)};
      },
      "engine"_a = LocalEngine::updated, "tight"_a = true, "threads"_a = 1, "progress"_a = nb::none());
  options.option("engine", &LocalOptions::engine)
      .option("tight", &LocalOptions::tight, "look for tight features")
      .option("threads", &LocalOptions::threads, "0: as many as there are cores")
      .option("progress", &LocalOptions::progress);
}

void bind_part(nb::module_& m) {
  Record<LocalPart> part(m, "LocalPart", "What a box cuts out of the boundary of a sum.", nb::dynamic_attr());
  enumeration<LocalPart::Where>(
      part, "Where", "How the box lies.",
      {"something is listed", "nothing is, and the box lies in the sum", "nothing is, and its inside lies outside"});
  Record<LocalPart::Work>(part, "Work", "What a part took.")
      .field("rebuilt", &LocalPart::Work::rebuilt, "the facets were found anew")
      .field("pairs", &LocalPart::Work::pairs, "of features that the bounding spheres left")
      .field("facets", &LocalPart::Work::facets, "of the convolution that come near the box")
      .field("contacts", &LocalPart::Work::contacts)
      .field("collision_tests", &LocalPart::Work::collision_tests)
      .field("tight_tests", &LocalPart::Work::tight_tests)
      .field("exact_signs", &LocalPart::Work::exact_signs)
      .field("ms", &LocalPart::Work::ms);
  part.field("boundary", &LocalPart::boundary,
             "faces and tight features cut to the box: an open surface, which has no volume")
      .field("box", &LocalPart::box, "that it is cut to")
      .field("where", &LocalPart::where)
      .field("work", &LocalPart::work, "no part of the value")
      .def("__reduce__", [](nb::handle_t<LocalPart> self) { return made_again(self); });
}

void bind_local_class(nb::module_& m) {
  nb::class_<Local> type(
      m, "LocalSum",
      R"doc(P (+) Q of solids near one place after the other, while both turn and scale: exactly the whole sum, cut.

One thread at a time; work is done without the GIL.

>>> from dymsum import ClipBall, ClipBox, LocalSum, solids
>>> box = solids.box(-1, -1, -1, 1, 1, 1)
>>> near = LocalSum(box, box)
>>> part = near.in_(ClipBox((1, 1, 0), (3, 3, 1)))
>>> part.where, len(part.boundary.faces), part.boundary.exact(0)
(Where.crossed, 2, RationalPoint3(x=Fraction(1, 1), y=Fraction(2, 1), z=Fraction(0, 1)))
>>> near.in_(ClipBall((0, 0, 0), 1.5)).where
Where.inside
)doc");
  type.def(
          "__init__",
          [](Local* self, const MeshArgument& p, const MeshArgument& q, const LocalOptions& options) {
            new (self) Local(p, q, options);
          },
          "p"_a, "q"_a, "options"_a = LocalOptions(),
          "Raises Error: out_of_range; unsupported_operand for parts without volume; cancelled.")
      .def_static(
          "create",
          [](const MeshArgument& p, const MeshArgument& q, const LocalOptions& options) {
            return new Local(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = LocalOptions())
      .def("in_", &Local::in<ClipBox>, "box"_a, "p"_a = SolidPose(), "q"_a = SolidPose(),
           "The sum at these poses cut to the box. Raises Error: out_of_range for a box without extent; not_finite; "
           "unsupported_operand where poses and box need more than 250 bits; cancelled.")
      .def("in_", &Local::in<ClipBall>, "ball"_a, "p"_a = SolidPose(), "q"_a = SolidPose(),
           "The same in the ball's bounding box, less what does not meet the closed ball.")
      .def(
          "facet_count", [](Local& self) { return self.held.alone([](LocalSum& sum) { return sum.facet_count(); }); },
          "Of the convolution at the last poses; 0 where it was not made.")
      .def_prop_ro("options", [](const Local& self) { return self.options; })
      .def("__reduce__", [](nb::handle_t<Local> self) {
        const auto* own = nb::inst_ptr<Local>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(own->p, own->q, without_progress(own->options)));
      });
}

}  // namespace

void bind_local_sum(nb::module_& m) {
  bind_positions(m);
  bind_local_options(m);
  bind_part(m);
  bind_local_class(m);
}

}  // namespace dymsum::python

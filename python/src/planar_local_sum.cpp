// Sums of regions near a position.
#include "dymsum/planar_local_sum.h"

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

/// A PlanarLocalSum, its operands and options, and the watch whose Progress it keeps.
struct PlanarLocal {
  PlanarLocal(const RegionArgument& p_of, const RegionArgument& q_of, const PlanarLocalOptions& o)
      : p(p_of.object), q(q_of.object), options(o), watch(o.progress), held(create(*p_of, *q_of)) {}

  PlanarLocalSum create(const Region& p_of, const Region& q_of) {
    PlanarLocalOptions own = options;
    own.progress = watch.progress();
    return watch.take(without_gil([&] { return PlanarLocalSum::create(p_of, q_of, own); }));
  }
  template <class Clip>
  Remembered<PlanarLocalPart> in(const Clip& clip, const PlanarPose& p_pose, const PlanarPose& q_pose) {
    PlanarLocalPart part = held.alone([&](PlanarLocalSum& sum) {
      watch.begin();
      return watch.take(without_gil([&] { return sum.in(clip, p_pose, q_pose); }));
    });
    return remembered(std::move(part), "planar_local_part", p, q, options, clip, p_pose, q_pose);
  }

  nb::object p, q;
  PlanarLocalOptions options;
  Watch watch;
  Held<PlanarLocalSum> held;
};

void bind_planar_positions(nb::module_& m) {
  Record<PlanarBox> box(m, "PlanarBox", "The closed box from `low` to `high`, in the unit of the coordinates.");
  box.def(
      "__init__",
      [](PlanarBox* self, const Point& low, const Point& high) {
        new (self) PlanarBox{low, high};
      },
      "low"_a, "high"_a);
  box.field("low", &PlanarBox::low).field("high", &PlanarBox::high);
  Record<PlanarDisc> disc(m, "PlanarDisc", "A closed disc: it selects edges, its bounding box cuts them.");
  disc.def(
      "__init__",
      [](PlanarDisc* self, const Point& centre, double radius) {
        new (self) PlanarDisc{centre, radius};
      },
      "centre"_a, "radius"_a);
  disc.field("centre", &PlanarDisc::centre).field("radius", &PlanarDisc::radius);
  m.def(
      "bounding_box", [](const PlanarDisc& of) { return bounding_box(of); }, "disc"_a,
      "The smallest box of doubles that holds the disc.");
  Record<PlanarLocalOptions> options(m, "PlanarLocalOptions", "Options of PlanarLocalSum.");
  options.def(
      "__init__",
      [](PlanarLocalOptions* self, LocalEngine engine, Progress progress, std::uint64_t memory) {
        new (self) PlanarLocalOptions{engine, std::move(progress), memory};
      },
      "engine"_a = LocalEngine::updated, "progress"_a = nb::none(), "memory"_a = 0);
  options.option("engine", &PlanarLocalOptions::engine)
      .option("progress", &PlanarLocalOptions::progress)
      .option("memory", &PlanarLocalOptions::memory,
              "bytes that arrays which grow faster than the operands may hold; 0: no limit");
}

void bind_planar_part(nb::module_& m) {
  Record<PlanarLocalPart> part(m, "PlanarLocalPart", "What a box cuts out of the boundary of a sum of regions.",
                               nb::dynamic_attr());
  enumeration<PlanarLocalPart::Where>(
      part, "Where", "How the box lies.",
      {"something is listed", "nothing is, and the box lies in the sum", "nothing is, and its inside lies outside"});
  Record<PlanarLocalPart::Edge>(part, "Edge", "A maximal segment of the boundary in the box, the sum on its left.")
      .field("from_", &PlanarLocalPart::Edge::from, "vertex")
      .field("to", &PlanarLocalPart::Edge::to, "vertex")
      .field("contact", &PlanarLocalPart::Edge::contact, "what touches along it");
  Record<PlanarLocalPart::Work>(part, "Work", "What a part took.")
      .field("rebuilt", &PlanarLocalPart::Work::rebuilt, "the segments were found anew")
      .field("pairs", &PlanarLocalPart::Work::pairs, "of features that were looked at")
      .field("segments", &PlanarLocalPart::Work::segments, "of the convolution that come near the box")
      .field("collision_tests", &PlanarLocalPart::Work::collision_tests)
      .field("exact_tests", &PlanarLocalPart::Work::exact_tests, "of these, that doubles did not decide")
      .field("ms", &PlanarLocalPart::Work::ms);
  part.field("vertices", &PlanarLocalPart::vertices, "the nearest doubles; sorted by x, then y")
      .field("edges", &PlanarLocalPart::edges)
      .field("tight_segments", &PlanarLocalPart::tight_segments)
      .field("tight_points", &PlanarLocalPart::tight_points, "vertices")
      .field("box", &PlanarLocalPart::box, "that it is cut to")
      .field("where", &PlanarLocalPart::where)
      .field("work", &PlanarLocalPart::work, "no part of the value")
      .def("exact", &PlanarLocalPart::exact, "vertex"_a, "The exact position of a vertex.")
      .def("__reduce__", [](nb::handle_t<PlanarLocalPart> self) { return made_again(self); });
  m.def("part_svg", &part_svg, "part"_a, "A picture of a part as an SVG document.");
}

void bind_planar_local(nb::module_& m) {
  nb::class_<PlanarLocal> type(
      m, "PlanarLocalSum",
      R"doc(P (+) Q of regions near one place after the other, while both turn and scale: exactly the whole sum, cut.

One thread at a time; work is done without the GIL.

>>> from dymsum import PlanarBox, PlanarDisc, PlanarLocalSum, shapes
>>> square = shapes.rectangle(-1, -1, 1, 1)
>>> near = PlanarLocalSum(square, square)
>>> part = near.in_(PlanarBox((1, 1), (3, 3)))
>>> part.where, len(part.edges), part.exact(2)
(Where.crossed, 2, RationalPoint(x=Fraction(2, 1), y=Fraction(2, 1)))
>>> near.in_(PlanarDisc((0, 0), 1.5)).where
Where.inside
)doc");
  type.def(
          "__init__",
          [](PlanarLocal* self, const RegionArgument& p, const RegionArgument& q, const PlanarLocalOptions& options) {
            new (self) PlanarLocal(p, q, options);
          },
          "p"_a, "q"_a, "options"_a = PlanarLocalOptions(),
          "Raises Error: unsupported_operand for polylines, points and coordinates beyond 2^1000; cancelled.")
      .def_static(
          "create",
          [](const RegionArgument& p, const RegionArgument& q, const PlanarLocalOptions& options) {
            return new PlanarLocal(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = PlanarLocalOptions())
      .def("in_", &PlanarLocal::in<PlanarBox>, "box"_a, "p"_a = PlanarPose(), "q"_a = PlanarPose(),
           "The sum at these poses cut to the box. Raises Error: out_of_range for a box without extent; not_finite; "
           "cancelled.")
      .def("in_", &PlanarLocal::in<PlanarDisc>, "disc"_a, "p"_a = PlanarPose(), "q"_a = PlanarPose(),
           "The same in the disc's bounding box, less what does not meet the closed disc.")
      .def_prop_ro("options", [](const PlanarLocal& self) { return self.options; })
      .def("__reduce__", [](nb::handle_t<PlanarLocal> self) {
        const auto* own = nb::inst_ptr<PlanarLocal>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(own->p, own->q, without_progress(own->options)));
      });
}

}  // namespace

void bind_planar_local_sum(nb::module_& m) {
  bind_planar_positions(m);
  bind_planar_part(m);
  bind_planar_local(m);
}

}  // namespace dymsum::python
